#include "station.h"

#include "flash_map.h"

#include <stdlib.h>
#include <string.h>
#include <unity.h>

#define HEAD_BYTES 5
#define STEP_US 50
#define PATIENCE_US 200000

/* A loader that checks its slots hears nothing meanwhile. */
#define SIGN_ONS 4

struct avr_image *station_open(const char *path)
{
    char error[300] = "";
    struct avr_image *image = avr_image_open(path, error, sizeof error);

    TEST_ASSERT_NOT_NULL_MESSAGE(image, error);
    return image;
}

void station_begin(struct station *station, struct avr_image *loader,
                   const struct avr_image *program)
{
    *station = (struct station){.loader = loader, .flash = own_flash_new()};
    TEST_ASSERT_NOT_NULL(station->flash);
    own_flash_put_loader(station->flash, loader);
    if (program != NULL)
        own_flash_put_program(station->flash, program);
}

void station_end(struct station *station)
{
    station_power_off(station);
    free(station->flash);
    station->flash = NULL;
}

void station_power_on(struct station *station)
{
    station->core = avr_core_new_with_flash(station->loader, station->flash);
    TEST_ASSERT_NOT_NULL(station->core);
}

void station_power_off(struct station *station)
{
    if (station->core != NULL)
        avr_core_free(station->core);
    station->core = NULL;
}

static bool cut_is_due(const struct station *station)
{
    return station->cut_at != 0 && station->flash->busy &&
           station->flash->operations == station->cut_at;
}

static uint64_t cycles_of(const struct station *station, uint32_t us)
{
    return (uint64_t)station->loader->f_cpu * us / 1000000;
}

bool station_run_us(struct station *station, uint32_t us)
{
    if (station->core == NULL)
        return false;

    uint64_t end = avr_core_cycle(station->core) + cycles_of(station, us);
    for (uint64_t now; (now = avr_core_cycle(station->core)) < end;) {
        uint64_t next = now + cycles_of(station, STEP_US);
        bool alive = avr_core_run(station->core, next < end ? next : end);

        TEST_ASSERT_NULL_MESSAGE(station->flash->fault, station->flash->fault);
        TEST_ASSERT_TRUE_MESSAGE(alive, "the chip has crashed");
        if (cut_is_due(station)) {
            station_power_off(station);
            return false;
        }
    }
    return true;
}

void station_send(struct station *station, const uint8_t *bytes, size_t count)
{
    if (station->core == NULL)
        return;
    avr_core_receive(station->core, avr_core_cycle(station->core), bytes, count);
    station_run_us(station, (uint32_t)(10 * count * 1000000 / station->loader->baud + STEP_US));
}

int station_hear(struct station *station, uint32_t us)
{
    uint8_t byte;

    for (uint32_t waited = 0; waited < us; waited += STEP_US) {
        if (station->core == NULL)
            return -1;
        if (avr_core_take_sent(station->core, &byte, 1) == 1)
            return byte;
        station_run_us(station, STEP_US);
    }
    return -1;
}

void station_ask(struct station *station, const uint8_t *body, uint16_t length)
{
    uint8_t message[HEAD_BYTES + BODY_MAX + 1] = {0x1B, ++station->number, (uint8_t)(length >> 8),
                                                  (uint8_t)length, 0x0E};
    uint8_t sum = 0;

    memcpy(message + HEAD_BYTES, body, length);
    for (int i = 0; i < HEAD_BYTES + length; i++)
        sum ^= message[i];
    message[HEAD_BYTES + length] = sum;
    station_send(station, message, HEAD_BYTES + length + 1u);
}

static bool take_answer(struct station *station)
{
    uint8_t head[HEAD_BYTES];
    int byte = station_hear(station, PATIENCE_US);
    uint8_t sum = 0;

    for (int i = 0; i < HEAD_BYTES; i++, byte = station_hear(station, PATIENCE_US)) {
        if (byte < 0)
            return false;
        head[i] = (uint8_t)byte;
        sum ^= head[i];
    }
    station->length = (uint16_t)(head[2] << 8 | head[3]);
    TEST_ASSERT_EQUAL_HEX8(0x1B, head[0]);
    TEST_ASSERT_EQUAL_HEX8(station->number, head[1]);
    TEST_ASSERT_EQUAL_HEX8(0x0E, head[4]);
    TEST_ASSERT_LESS_OR_EQUAL(BODY_MAX, station->length);
    for (int i = 0; i < station->length; i++, byte = station_hear(station, PATIENCE_US)) {
        station->answer[i] = (uint8_t)byte;
        sum ^= station->answer[i];
        if (byte < 0)
            return false;
    }
    TEST_ASSERT_EQUAL_HEX8(sum, byte);
    return true;
}

int station_command(struct station *station, const uint8_t *body, uint16_t length)
{
    uint8_t command = body[0];

    station_ask(station, body, length);
    if (!take_answer(station))
        return -1;
    TEST_ASSERT_EQUAL_HEX8(command, station->answer[0]);
    return station->answer[1];
}

bool station_sign_on(struct station *station)
{
    for (int i = 0; i < SIGN_ONS; i++)
        if (station_command(station, (uint8_t[]){0x01}, 1) == 0)
            return true;
    return false;
}

int station_write_page(struct station *station, uint16_t at, const uint8_t *bytes, uint16_t count)
{
    uint16_t words = at / 2;
    uint8_t body[10 + FLASH_PAGE_BYTES] = {0x13, (uint8_t)(count >> 8), (uint8_t)count};
    uint8_t address[] = {0x06, 0x80, 0, (uint8_t)(words >> 8), (uint8_t)words};

    memcpy(body + 10, bytes, count);
    if (station_command(station, address, sizeof address) != 0)
        return -1;
    return station_command(station, body, 10 + count);
}

static bool write_pages(struct station *station, const struct avr_image *program)
{
    const struct seal *seal = (const struct seal *)(program->flash + SEAL_AT);

    for (uint32_t at = 0; at < SLOT_BYTES; at += FLASH_PAGE_BYTES)
        if ((at < seal->length || at + FLASH_PAGE_BYTES == SLOT_BYTES) &&
            station_write_page(station, (uint16_t)at, program->flash + at, FLASH_PAGE_BYTES) != 0)
            return false;
    return true;
}

bool station_update(struct station *station, const struct avr_image *program)
{
    uint8_t erase[] = {0x12, 0, 0, 0, 0, 0, 0};

    return station_sign_on(station) && station_command(station, erase, sizeof erase) == 0 &&
           write_pages(station, program) &&
           station_command(station, (uint8_t[]){0x11, 0, 0}, 3) == 0;
}
