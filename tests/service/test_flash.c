#include "avr_image.h"
#include "flash_map.h"
#include "hand.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unity.h>

#define ROBOTS 4
#define ELF_BYTES_MAX 1000000

/* An interrupt's vector that no robot uses: SPM_READY's. */
#define UNUSED_AT (34 * 4)

static struct hand hand;
static uint32_t old_crc, new_crc;
static char older[128]; /* path */

/* ---- another program ------------------------------------------------------------------- */

static uint32_t crc_of(const uint8_t *bytes, size_t count)
{
    uint32_t crc = 0xFFFFFFFF;

    for (size_t bit = 0; bit < 8 * count; bit++) {
        bool low = (crc ^ (uint32_t)bytes[bit / 8] >> bit % 8) & 1;

        crc = crc >> 1 ^ (low ? 0xEDB88320 : 0);
    }
    return ~crc;
}

static uint32_t crc_at(const uint8_t *seal)
{
    return seal[4] | seal[5] << 8 | seal[6] << 16 | (uint32_t)seal[7] << 24;
}

static uint8_t *find(uint8_t *elf, size_t count, const uint8_t *bytes, size_t length)
{
    for (uint8_t *at = elf; at + length <= elf + count; at++)
        if (memcmp(at, bytes, length) == 0)
            return at;
    TEST_FAIL_MESSAGE("muster.elf does not hold what its flash does");
    return NULL;
}

static void copy(const char *from, const char *to, void (*change)(uint8_t *elf, size_t count))
{
    uint8_t *elf = malloc(ELF_BYTES_MAX);
    FILE *in = fopen(from, "rb"), *out = fopen(to, "wb");

    TEST_ASSERT_TRUE(elf != NULL && in != NULL && out != NULL);
    size_t count = fread(elf, 1, ELF_BYTES_MAX, in);
    change(elf, count);
    TEST_ASSERT_EQUAL_UINT64(count, fwrite(elf, 1, count, out));
    fclose(in);
    TEST_ASSERT_EQUAL_INT(0, fclose(out));
    free(elf);
}

/* One byte that nobody reads, and the seal that goes with it. */
static void make_older(uint8_t *elf, size_t count)
{
    char error[256] = "";
    struct avr_image *image = avr_image_open(STAGE_FIRMWARE, error, sizeof error);

    TEST_ASSERT_NOT_NULL_MESSAGE(image, error);
    uint8_t *seal = image->flash + SEAL_AT;
    uint8_t *code = find(elf, count, image->flash, FLASH_PAGE_BYTES);
    uint8_t *sealed = find(elf, count, seal, sizeof(struct seal));
    size_t length = seal[0] | (size_t)seal[1] << 8;

    new_crc = crc_at(seal);
    code[UNUSED_AT + 2] ^= 1;
    image->flash[UNUSED_AT + 2] ^= 1;
    old_crc = crc_of(image->flash, length);
    for (int i = 0; i < 4; i++)
        sealed[4 + i] = (uint8_t)(old_crc >> 8 * i);
    avr_image_close(image);
}

/* ---- tests ----------------------------------------------------------------------------- */

#define RUN(...) hand_run(&hand, (const char *const[]){__VA_ARGS__, NULL})

static const char *site;

void setUp(void)
{
    hand_open(&hand);
    snprintf(older, sizeof older, "%s/older.elf", hand.directory);
    copy(STAGE_FIRMWARE, older, make_older);
    hand_add(&hand, (const char *const[]){"--id", "1..4", "--link", "tcp:127.0.0.1:0", "--firmware",
                                          older, NULL});
    site = hand_site(&hand, (const unsigned[]){1, 2, 3, 4, 0});
}

void tearDown(void)
{
    hand_close(&hand);
}

static void has_said(const char *format, unsigned robot)
{
    char words[160];

    snprintf(words, sizeof words, format, robot, (unsigned long)old_crc, (unsigned long)new_crc);
    TEST_ASSERT_TRUE_MESSAGE(hand_said(&hand, words), words);
}

static void test_four_robots_are_given_another_program(void)
{
    /* They are up then, and not in their loaders, which would not be asked what they had. */
    TEST_ASSERT_EQUAL_INT(0, RUN("param", "get", site, "image"));
    TEST_ASSERT_EQUAL_INT(0, RUN("flash", site));
    for (unsigned id = 1; id <= ROBOTS; id++)
        has_said("robot %u: %08lX -> %08lX, verified, runs\n", id);
    has_said("%u of 4 robots run ", ROBOTS);

    TEST_ASSERT_EQUAL_INT(0, RUN("flash", site));
    for (unsigned id = 1; id <= ROBOTS; id++)
        has_said("robot %u: has ", id);
    TEST_ASSERT_TRUE(hand_said(&hand, " already\n"));
}

/* Robots that are switched off and on, a command that is interrupted and given again. */
static void test_an_update_that_breaks_off_is_taken_up_again(void)
{
    char image[16];

    hand_start(&hand, (const char *const[]){"flash", site, "--robots", "2,3", NULL});
    hand_hears(&hand, 0, "its host is there");
    hand_power_cycle(&hand, 0);
    process_signal(&hand.command, SIGINT);
    TEST_ASSERT_EQUAL_INT(1, hand_end(&hand));
    TEST_ASSERT_TRUE(hand_said(&hand, "interrupted"));
    has_said("%u of 2 robots run ", 0);

    hand_start(&hand, (const char *const[]){"flash", site, "--robots", "2,3", NULL});
    hand_power_cycle(&hand, 0);
    TEST_ASSERT_EQUAL_INT(0, hand_end(&hand));
    has_said("%u of 2 robots run ", 2);
    hand_power_cycle(&hand, 0);
    TEST_ASSERT_EQUAL_INT(0, RUN("param", "get", site, "image", "--robots", "2,3"));
    snprintf(image, sizeof image, "%08lX", (unsigned long)new_crc);
    TEST_ASSERT_TRUE(hand_said(&hand, image));
}

static void test_a_program_for_another_baud_rate_is_refused(void)
{
    TEST_ASSERT_EQUAL_INT(2, RUN("flash", site, "--set", "robots.1.baud=57600"));
    TEST_ASSERT_TRUE(hand_said(&hand, "speaks at 115200 baud, robot 2's link at 57600"));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_four_robots_are_given_another_program);
    RUN_TEST(test_an_update_that_breaks_off_is_taken_up_again);
    RUN_TEST(test_a_program_for_another_baud_rate_is_refused);
    return UNITY_END();
}
