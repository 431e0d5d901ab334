#include "arithmetic.h"

#include "chip.h"
#include "crew.h"
#include "report.h"

#include <stdio.h>
#include <unity.h>

/* No portion takes a chip longer. */
#define PATIENCE_S 100
#define STEP_CYCLES 1000000

#define JOBS (ARITHMETIC_FUNCTIONS * PORTIONS)
#define REPORT_BYTES (4 * BLOCKS_PER_PORTION + 1)

static struct avr_image *image;
static uint8_t reports[JOBS][REPORT_BYTES];

void setUp(void)
{
}
void tearDown(void)
{
}

/* In a thread of its own, where nothing can be asserted: an image that fails reports less. */
static void run_chip(void *context, size_t job)
{
    const uint8_t orders[] = {[EEPROM_FUNCTION] = (uint8_t)(job / PORTIONS),
                              [EEPROM_PORTION] = (uint8_t)(job % PORTIONS)};
    struct avr_core *core = avr_core_new(image);
    uint64_t cycle = 0;
    size_t got = 0;

    (void)context;
    if (core == NULL)
        return;
    avr_core_write_eeprom(core, 0, orders, sizeof orders);
    while (got < REPORT_BYTES && cycle < (uint64_t)image->f_cpu * PATIENCE_S) {
        cycle += STEP_CYCLES;
        if (!avr_core_run(core, cycle))
            break;
        got += avr_core_take_sent(core, reports[job] + got, REPORT_BYTES - got);
    }
    avr_core_free(core);
}

static void judge(size_t job)
{
    uint8_t function = (uint8_t)(job / PORTIONS);
    char words[80];

    for (uint8_t i = 0; i < BLOCKS_PER_PORTION; i++) {
        uint8_t block = (uint8_t)(job % PORTIONS * BLOCKS_PER_PORTION + i);
        const uint8_t *hash = reports[job] + 4 * i;

        snprintf(words, sizeof words, "%s, block %u of %u rounds", arithmetic[function].name, block,
                 ROUNDS_PER_BLOCK);
        TEST_ASSERT_EQUAL_HEX32_MESSAGE(arithmetic_hash(function, block),
                                        hash[0] | (uint32_t)hash[1] << 8 | (uint32_t)hash[2] << 16 |
                                            (uint32_t)hash[3] << 24,
                                        words);
    }
    TEST_ASSERT_EQUAL_HEX8_MESSAGE(REPORT_END, reports[job][REPORT_BYTES - 1],
                                   arithmetic[function].name);
}

static void test_the_chip_computes_the_same_bits(void)
{
    struct crew *crew = crew_new(2);

    TEST_ASSERT_NOT_NULL(crew);
    crew_run(crew, JOBS, run_chip, NULL);
    crew_free(crew);
    for (size_t job = 0; job < JOBS; job++)
        judge(job);
}

int main(int argc, char **argv)
{
    char error[300] = "";

    (void)argc;
    UNITY_BEGIN();
    image = avr_image_open(argv[1], error, sizeof error);
    if (image == NULL) {
        fputs(error, stderr);
        return 1;
    }
    RUN_TEST(test_the_chip_computes_the_same_bits);
    avr_image_close(image);
    return UNITY_END();
}
