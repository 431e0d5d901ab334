#include "chip.h"

#include "../../firmware/atmega128/pins.h"
#include "atmega128.h"
#include "report.h"

#include <unity.h>

/* No image has to be waited for longer. */
#define PATIENCE_S 10

const char *chip_path;

void chip_start(struct chip *chip)
{
    char error[300] = "";

    *chip = (struct chip){0};
    chip->image = avr_image_open(chip_path, error, sizeof error);
    TEST_ASSERT_NOT_NULL_MESSAGE(chip->image, error);
    chip->core = avr_core_new(chip->image);
    TEST_ASSERT_NOT_NULL(chip->core);
    frame_decoder_init(&chip->decoder);
}

void chip_stop(struct chip *chip)
{
    if (chip->core != NULL)
        avr_core_free(chip->core);
    if (chip->image != NULL)
        avr_image_close(chip->image);
}

static void run_until(struct chip *chip, uint64_t cycle)
{
    TEST_ASSERT_TRUE_MESSAGE(avr_core_run(chip->core, cycle), "the chip has crashed");
}

static void run_on(struct chip *chip, uint32_t cycles, const char *waiting_for)
{
    uint64_t now = avr_core_cycle(chip->core);

    TEST_ASSERT_TRUE_MESSAGE(now < (uint64_t)chip->image->f_cpu * PATIENCE_S, waiting_for);
    run_until(chip, now + cycles);
}

void chip_run_us(struct chip *chip, uint32_t us)
{
    uint64_t cycles = (uint64_t)chip->image->f_cpu * us / 1000000;

    run_until(chip, avr_core_cycle(chip->core) + cycles);
}

void chip_await_led(struct chip *chip)
{
    const uint8_t *data = avr_core_data(chip->core);

    while (!(data[PIN_PORT(PIN_LED)] & data[PIN_DDR(PIN_LED)] & PIN_MASK(PIN_LED)))
        run_on(chip, 100, "waited in vain for the LED");
}

void chip_read(struct chip *chip, uint8_t *bytes, size_t count)
{
    size_t got = 0;

    while ((got += avr_core_take_sent(chip->core, bytes + got, count - got)) < count)
        run_on(chip, 1000, "waited in vain for bytes");
}

void chip_await_end(struct chip *chip)
{
    uint8_t byte;

    chip_read(chip, &byte, 1);
    TEST_ASSERT_EQUAL_HEX8(REPORT_END, byte);
}

void chip_write(struct chip *chip, const uint8_t *bytes, size_t count)
{
    uint64_t start = avr_core_cycle(chip->core);
    uint64_t bits = 10 * (uint64_t)count;

    avr_core_receive(chip->core, start, bytes, count);
    run_until(chip, start + bits * chip->image->f_cpu / chip->image->baud + 100);
}
