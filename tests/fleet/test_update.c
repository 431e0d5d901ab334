/* `muster flash` in virtual time: four robots with boot loaders at once, over links that are cut
 * and noisy, with power that fails at any moment. A robot has always one whole program: it runs the
 * old one or the new one, and says which. */
#include "avr_image.h"
#include "flash_map.h"
#include "frame.h"
#include "message.h"
#include "parameter_table.h"
#include "program.h"
#include "random.h"
#include "rehearsal.h"
#include "update.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unity.h>

#define ROBOTS 4
#define FLASH_BYTES 0x20000u
#define PERIOD_S 0.02
#define SECOND_US 1000000

/* What makes two programs of one: so many bytes behind it, which differ. */
#define PADDING (24 * FLASH_PAGE_BYTES)

/* ---- programs -------------------------------------------------------------------------- */

static struct avr_image *image, *loader;
static uint8_t old_flash[FLASH_BYTES], new_flash[FLASH_BYTES];
static struct avr_image old_image, new_image;
static struct program program;

/* Bit by bit, as it is defined. */
static uint32_t crc_of(const uint8_t *bytes, size_t count)
{
    uint32_t crc = 0xFFFFFFFF;

    for (size_t bit = 0; bit < 8 * count; bit++) {
        bool low = (crc ^ (uint32_t)bytes[bit / 8] >> bit % 8) & 1;

        crc = crc >> 1 ^ (low ? 0xEDB88320 : 0);
    }
    return ~crc;
}

static uint16_t word_at(const uint8_t *bytes)
{
    return (uint16_t)(bytes[0] | bytes[1] << 8);
}

/* The CRC of the program that begins there; 0: it is not whole. */
static uint32_t whole(const uint8_t *slot)
{
    const uint8_t *seal = slot + SEAL_AT;
    uint16_t length = word_at(seal);
    uint32_t crc = (uint32_t)(word_at(seal + 4) | (uint32_t)word_at(seal + 6) << 16);

    if ((length ^ word_at(seal + 2)) != 0xFFFF || length == 0 || length > PROGRAM_BYTES_MAX)
        return 0;
    return crc_of(slot, length) == crc ? crc : 0;
}

static void make_program(uint8_t *flash, struct avr_image *made, uint32_t padding)
{
    uint8_t *seal = flash + SEAL_AT;

    memcpy(flash, image->flash, FLASH_BYTES);
    uint16_t length = word_at(seal) + PADDING;
    for (uint16_t at = word_at(seal); at < length; at++)
        flash[at] = (uint8_t)random_next(&padding);
    uint32_t crc = crc_of(flash, length);
    const uint16_t words[] = {length, (uint16_t)~length, (uint16_t)crc, (uint16_t)(crc >> 16)};
    for (int i = 0; i < 4; i++) {
        seal[2 * i] = (uint8_t)words[i];
        seal[2 * i + 1] = (uint8_t)(words[i] >> 8);
    }
    *made = *image;
    made->flash = flash;
}

static void make_programs(const char *firmware, const char *boot_loader)
{
    char error[512] = "";

    image = avr_image_open(firmware, error, sizeof error);
    TEST_ASSERT_NOT_NULL_MESSAGE(image, error);
    loader = avr_image_open(boot_loader, error, sizeof error);
    TEST_ASSERT_NOT_NULL_MESSAGE(loader, error);
    make_program(old_flash, &old_image, 1);
    make_program(new_flash, &new_image, 2);
    TEST_ASSERT_TRUE_MESSAGE(program_take(&program, new_flash, image->baud, error, sizeof error),
                             error);
}

/* ---- robots ---------------------------------------------------------------------------- */

static struct rehearsal_member member[ROBOTS];
static struct update update[ROBOTS];
static struct link_timing timing;
static int64_t now_us;
static uint32_t chance;
static clock_t began;

static void switch_on(size_t i)
{
    struct sim_robot *robot = member[i].robot;

    TEST_ASSERT_TRUE(robot->kind->power_on(robot));
    member[i].off = false;
}

/* Nobody speaks to its loader, which then starts it. */
static void let_program_start(struct sim_robot *robot)
{
    struct robot_period period;

    for (double s = 0; s < 2; s += PERIOD_S)
        robot->kind->run(robot, NULL, 0, &period);
}

static void begin(void)
{
    static const struct update_options options = {0};

    timing = link_timing_of(image->baud);
    memset(member, 0, sizeof member);
    for (uint16_t i = 0; i < ROBOTS; i++) {
        update_begin(&update[i], &program, i + 1, &options);
        member[i].job = &update[i].job;
        member[i].robot = robot_avr_with_loader(i + 1, &old_image, loader);
        TEST_ASSERT_NOT_NULL(member[i].robot);
        switch_on(i);
        let_program_start(member[i].robot);
    }
}

void setUp(void)
{
    now_us = 0;
    chance = 20260722;
    began = clock();
}

void tearDown(void)
{
    for (size_t i = 0; i < ROBOTS; i++) {
        if (member[i].robot != NULL)
            member[i].robot->kind->destroy(member[i].robot);
        member[i].robot = NULL;
    }
    printf("%.1f s of processor time\n", (double)(clock() - began) / CLOCKS_PER_SEC);
}

static uint32_t runs_by_flash(size_t i)
{
    return whole(robot_loader_flash(member[i].robot));
}

static void let_pass_until(int64_t end_us)
{
    size_t crashed = 0;

    while (now_us < end_us)
        TEST_ASSERT_TRUE(rehearsal_tick(member, ROBOTS, &timing, &now_us, &crashed));
}

static bool all_have_ended(void)
{
    for (size_t i = 0; i < ROBOTS; i++)
        if (update[i].job.state == JOB_WORKING)
            return false;
    return true;
}

static void all_run_the_new_one(void)
{
    for (size_t i = 0; i < ROBOTS; i++) {
        TEST_ASSERT_EQUAL_INT_MESSAGE(JOB_DONE, update[i].job.state, update[i].job.words);
        TEST_ASSERT_EQUAL_HEX32(program.crc, runs_by_flash(i));
    }
}

/* ---- a robot that is left to itself ---------------------------------------------------- */

struct witness {
    struct frame_decoder decoder;
    bool spoke;
    uint32_t runs; /* 0: it has not said */
};

static void hear(struct witness *witness, const struct robot_period *period)
{
    struct message message;

    for (uint16_t i = 0; i < period->sent; i++) {
        if (frame_decode(&witness->decoder, period->tx[i]) != FRAME_READY ||
            !message_read(&message, witness->decoder.payload, witness->decoder.length))
            continue;
        witness->spoke |= message.type == MESSAGE_STATUS;
        if (message.type == MESSAGE_ANSWER && message.answer.index == PARAMETER_IMAGE)
            witness->runs = message.answer.value;
    }
}

/* It starts with nobody on its link; only when it has spoken it is asked what it runs. */
static uint32_t starts(struct sim_robot *robot)
{
    const struct message question = {
        .type = MESSAGE_ASK,
        .ask = {.tag = 77, .action = PARAMETER_GET, .index = PARAMETER_IMAGE},
    };
    struct witness witness = {0};
    struct robot_period period;
    uint8_t payload[FRAME_PAYLOAD_MAX], frame[FRAME_BYTES_MAX];
    uint8_t length = frame_encode(frame, payload, message_write(payload, &question));

    frame_decoder_init(&witness.decoder);
    TEST_ASSERT_TRUE(robot->kind->power_on(robot));
    for (double s = 0; s < 6 && witness.runs == 0; s += PERIOD_S) {
        robot->kind->run(robot, frame, witness.spoke ? length : 0, &period);
        TEST_ASSERT_FALSE(period.crashed);
        hear(&witness, &period);
    }
    robot->kind->power_off(robot);
    TEST_ASSERT_TRUE(witness.spoke);
    return witness.runs;
}

/* ---- power that fails ------------------------------------------------------------------ */

enum phase { PROGRAM, STARTING, STAGING, SEALING, INSTALLING, PHASES };

/* How many cuts a robot gets in each, and how likely one is in a period of it. */
static const struct {
    const char *name;
    unsigned cuts, periods;
} plan[PHASES] = {
    [PROGRAM] = {"the program runs", 6, 4},        [STARTING] = {"the loader starts", 8, 12},
    [STAGING] = {"pages go to the stage", 32, 16}, [SEALING] = {"the seal goes to the stage", 6, 3},
    [INSTALLING] = {"the loader installs", 8, 12},
};

static enum phase phase_of(size_t i)
{
    const struct update *u = &update[i];
    const uint8_t *flash = robot_loader_flash(member[i].robot);
    uint32_t staged = whole(flash + STAGE_START);

    if (staged == program.crc && whole(flash) != program.crc)
        return INSTALLING;
    if (u->step == UPDATE_ASK || u->step == UPDATE_CALL)
        return PROGRAM;
    if (u->step < UPDATE_ENTER)
        return STARTING;
    return u->page + 1 == program_pages(&program) ? SEALING : STAGING;
}

/* In the midst of the period that begins. What is there then: */
static void cut_power(size_t i)
{
    struct rehearsal_member *m = &member[i];
    const uint8_t *flash = robot_loader_flash(m->robot);
    size_t count = m->waiting < timing.slots ? m->waiting : timing.slots;

    robot_loader_cut(m->robot, m->bytes, count, PERIOD_S * (random_next(&chance) % 1000) / 1000);
    m->off = true;

    uint32_t slot = whole(flash), stage = whole(flash + STAGE_START);
    if (slot != whole(old_flash) && slot != program.crc)
        TEST_ASSERT_EQUAL_HEX32(program.crc, stage);
}

static void starts_old_or_new(size_t i)
{
    uint32_t runs = starts(member[i].robot);

    if (runs != whole(old_flash))
        TEST_ASSERT_EQUAL_HEX32(program.crc, runs);
    TEST_ASSERT_EQUAL_HEX32(runs, runs_by_flash(i));
}

/* ---- tests ----------------------------------------------------------------------------- */

static void test_four_robots_are_updated_at_once(void)
{
    char words[JOB_WORDS_MAX];

    begin();
    TEST_ASSERT_TRUE(rehearsal_run(member, ROBOTS, &timing, &now_us, 120ll * SECOND_US));
    all_run_the_new_one();
    snprintf(words, sizeof words, "%08lX -> %08lX, verified, runs", (unsigned long)whole(old_flash),
             (unsigned long)program.crc);
    for (size_t i = 0; i < ROBOTS; i++)
        TEST_ASSERT_EQUAL_STRING(words, update[i].job.words);
    printf("%u bytes into %d robots at once: %.1f s\n", program.length, ROBOTS,
           (double)now_us / 1e6);
}

/* And a link that is cut on the way, for a while. */
static void test_power_may_fail_at_any_moment(void)
{
    unsigned left[ROBOTS][PHASES], cuts[PHASES] = {0}, all = 0, alone = 0;
    int64_t on_us[ROBOTS] = {0};

    for (size_t i = 0; i < ROBOTS; i++)
        for (int phase = 0; phase < PHASES; phase++)
            left[i][phase] = plan[phase].cuts;
    begin();
    while (!all_have_ended() && now_us < 900ll * SECOND_US) {
        member[1].cut = now_us > 20ll * SECOND_US && now_us < 26ll * SECOND_US;
        for (size_t i = 0; i < ROBOTS; i++) {
            if (member[i].off) {
                if (now_us >= on_us[i])
                    switch_on(i);
                continue;
            }
            if (update[i].job.state != JOB_WORKING)
                continue;
            enum phase phase = phase_of(i);
            if (left[i][phase] == 0 || random_next(&chance) % plan[phase].periods != 0)
                continue;
            cut_power(i);
            left[i][phase]--;
            cuts[phase]++;
            on_us[i] = now_us + random_next(&chance) % 100000;
            if (++all % 8 == 0) {
                starts_old_or_new(i);
                alone++;
            }
        }
        let_pass_until(now_us + 1);
    }
    all_run_the_new_one();
    for (int phase = 0; phase < PHASES; phase++) {
        printf("power cut while %s: %u times\n", plan[phase].name, cuts[phase]);
        TEST_ASSERT_TRUE(cuts[phase] > 0);
    }
    printf("%u times in %.0f s, after %u of them started alone\n", all, (double)now_us / 1e6,
           alone);
    TEST_ASSERT_TRUE(all >= 200);
}

/* Wherever that is, the robot starts what it had when its loader has waited long enough; or the new
 * one, where all of that was there. */
static void test_a_link_may_be_cut_for_good(void)
{
    static const unsigned pages[ROBOTS] = {0, 1, 60, UINT16_MAX};

    begin();
    while (!all_have_ended()) {
        for (size_t i = 0; i < ROBOTS; i++)
            member[i].cut |= update[i].page > pages[i] || update[i].leaves > 0;
        let_pass_until(now_us + 1);
    }
    let_pass_until(now_us + 5ll * SECOND_US);
    for (size_t i = 0; i < ROBOTS; i++) {
        uint32_t runs = pages[i] < UINT16_MAX ? whole(old_flash) : program.crc;

        printf("robot %d: %s\n", (int)i + 1, update[i].job.words);
        TEST_ASSERT_EQUAL_INT(JOB_FAILED, update[i].job.state);
        TEST_ASSERT_EQUAL_HEX32(runs, starts(member[i].robot));
        TEST_ASSERT_EQUAL_HEX32(runs, runs_by_flash(i));
    }
}

/* ---- noise ----------------------------------------------------------------------------- */

#define BYTES_PER_ERROR 3000

static void spoil(uint8_t *bytes, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (random_next(&chance) % BYTES_PER_ERROR == 0)
            bytes[i] ^= (uint8_t)(1 << random_next(&chance) % 8);
}

static const struct job_kind *quiet;

static void received(struct job *job, const uint8_t *bytes, size_t count, int64_t at_us)
{
    uint8_t spoiled[ROBOT_TX_MAX];

    memcpy(spoiled, bytes, count);
    spoil(spoiled, count);
    quiet->received(job, spoiled, count, at_us);
}

static size_t send(struct job *job, int64_t at_us, uint8_t *bytes, size_t room)
{
    size_t count = quiet->send(job, at_us, bytes, room);

    spoil(bytes, count);
    return count;
}

static void test_noise_on_the_links_spoils_nothing(void)
{
    struct job_kind noisy;

    begin();
    quiet = update[0].job.kind;
    noisy = *quiet;
    noisy.received = received;
    noisy.send = send;
    for (size_t i = 0; i < ROBOTS; i++)
        update[i].job.kind = &noisy;
    TEST_ASSERT_TRUE(rehearsal_run(member, ROBOTS, &timing, &now_us, 300ll * SECOND_US));
    all_run_the_new_one();
    printf("one byte in %d changed: %.1f s\n", BYTES_PER_ERROR, (double)now_us / 1e6);
}

int main(int argc, char **argv)
{
    if (argc != 3)
        return EXIT_FAILURE;
    make_programs(argv[1], argv[2]);
    UNITY_BEGIN();
    RUN_TEST(test_four_robots_are_updated_at_once);
    RUN_TEST(test_power_may_fail_at_any_moment);
    RUN_TEST(test_a_link_may_be_cut_for_good);
    RUN_TEST(test_noise_on_the_links_spoils_nothing);
    return UNITY_END();
}
