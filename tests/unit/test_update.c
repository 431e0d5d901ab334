#include "update.h"

#include "frame.h"
#include "random.h"

#include <string.h>
#include <unity.h>

#define TICK_US 20000
#define SECOND_US 1000000
#define OLD 0x0123ABCDu
#define NEW 0x89ABCDEFu
#define PAGES 21 /* 20 of the program, one of the seal */

/* A robot that is nothing but its end of the link: its program's words and its loader's. */
struct robot {
    bool off, in_loader, deaf;
    uint16_t id;
    uint32_t runs;
    bool asks;         /* its program knows MESSAGE_ASK and MESSAGE_LOADER */
    bool on_mission;   /* until it is halted */
    int64_t status_us; /* when the next one is due */
    struct frame_decoder decoder;

    uint8_t stage[SLOT_BYTES];
    uint8_t signature[3];
    struct stk500_reader reader;
    uint16_t address;
    bool listens; /* to more than SIGN_ON, which came */
    unsigned signed_on, writes, reads, leaves;
    bool worn;     /* a page does not keep what is written */
    bool stays;    /* in its loader when that is left */
    bool refuses;  /* to take the update when the loader is left */
    unsigned mute; /* every so manieth answer is not sent; 0: none */
    unsigned answers;

    uint8_t out[2 * STK500_MESSAGE_MAX + FRAME_BYTES_MAX];
    size_t length;
};

/* What is on its way from the robot: by the tick it was sent in. */
#define TICKS_MAX 32
static struct {
    uint8_t bytes[2 * STK500_MESSAGE_MAX + FRAME_BYTES_MAX];
    size_t length;
} way[TICKS_MAX];
static unsigned ticks, delay; /* in ticks */

static struct program program;
static struct robot robot;
static struct update update;
static int64_t now_us;
static bool cut;

/* ---- the robot ------------------------------------------------------------------------- */

static void say(const uint8_t *bytes, size_t count)
{
    memcpy(robot.out + robot.length, bytes, count);
    robot.length += count;
}

static void say_frame(const struct message *message)
{
    uint8_t payload[FRAME_PAYLOAD_MAX], frame[FRAME_BYTES_MAX];

    say(frame, frame_encode(frame, payload, message_write(payload, message)));
}

static void say_status(void)
{
    const struct message message = {
        .type = MESSAGE_STATUS,
        .status = {.id = robot.id, .state = robot.on_mission ? STATE_RUN : STATE_IDLE},
    };

    if (now_us < robot.status_us)
        return;
    say_frame(&message);
    robot.status_us = now_us + SECOND_US / 2;
}

static void take_frame(void)
{
    struct message message;

    TEST_ASSERT_TRUE(message_read(&message, robot.decoder.payload, robot.decoder.length));
    if (message.type == MESSAGE_KEEPALIVE && message.keepalive.time < 0)
        robot.on_mission = false;
    if (!robot.asks)
        return;
    if (message.type == MESSAGE_LOADER && !robot.on_mission) {
        robot.in_loader = true;
        robot.listens = false;
        robot.reader.count = 0;
    } else if (message.type == MESSAGE_ASK) {
        TEST_ASSERT_EQUAL_UINT8(PARAMETER_GET, message.ask.action);
        TEST_ASSERT_EQUAL_UINT8(PARAMETER_IMAGE, message.ask.index);
        const struct message answer = {
            .type = MESSAGE_ANSWER,
            .answer = {robot.id, message.ask.tag, PARAMETER_DONE, PARAMETER_IMAGE, robot.runs},
        };
        say_frame(&answer);
    }
}

static void answer_body(const uint8_t *body, uint16_t length)
{
    uint8_t bytes[STK500_MESSAGE_MAX];

    if (robot.mute == 0 || ++robot.answers % robot.mute != 0)
        say(bytes, stk500_write(bytes, robot.reader.sequence, body, length));
}

/* A program that is whole is installed and started at once. */
static void leave(void)
{
    robot.leaves++;
    if (robot.stays)
        return;
    robot.in_loader = false;
    robot.status_us = now_us + SECOND_US;
    if (!robot.refuses && memcmp(robot.stage, program.slot, SLOT_BYTES) == 0)
        robot.runs = program.crc;
}

static void program_page(const uint8_t *bytes)
{
    robot.writes++;
    memcpy(robot.stage + 2 * robot.address, bytes, FLASH_PAGE_BYTES);
    if (robot.worn)
        robot.stage[2 * robot.address] ^= 1;
    robot.address += FLASH_PAGE_BYTES / 2;
}

static void answer(const uint8_t *body)
{
    static const uint8_t name[] = {STK500_SIGN_ON, 0, 8, 'A', 'V', 'R', 'I', 'S', 'P', '_', '2'};
    uint8_t out[STK500_BODY_MAX] = {body[0], STK500_OK};

    if (!robot.listens && body[0] != STK500_SIGN_ON)
        return;
    switch (body[0]) {
    case STK500_SIGN_ON:
        robot.listens = true;
        robot.signed_on++;
        answer_body(name, sizeof name);
        return;
    case STK500_SPI_MULTI:
        out[5] = robot.signature[body[6]];
        answer_body(out, 7);
        return;
    case STK500_LOAD_ADDRESS: robot.address = (uint16_t)(body[3] << 8 | body[4]); break;
    case STK500_READ_FLASH:
        robot.reads++;
        memcpy(out + 2, robot.stage + 2 * robot.address, FLASH_PAGE_BYTES);
        robot.address += FLASH_PAGE_BYTES / 2;
        answer_body(out, 3 + FLASH_PAGE_BYTES);
        return;
    case STK500_PROGRAM_FLASH: program_page(body + 10); break;
    default: break;
    }
    answer_body(out, 2);
    if (body[0] == STK500_LEAVE_PROGMODE)
        leave();
}

static void hear(const uint8_t *bytes, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (robot.in_loader && stk500_read(&robot.reader, bytes[i]))
            answer(robot.reader.body);
        else if (!robot.in_loader && frame_decode(&robot.decoder, bytes[i]) == FRAME_READY)
            take_frame();
    }
}

/* ---- time ------------------------------------------------------------------------------ */

static void tick(void)
{
    uint8_t bytes[512];
    struct job *job = &update.job;
    size_t count = job->kind->send(job, now_us, bytes, cut ? 0 : sizeof bytes);

    if (job->state != JOB_WORKING)
        return;
    robot.length = 0;
    if (!cut && !robot.off && !robot.deaf)
        hear(bytes, count);
    if (!robot.off && !robot.in_loader)
        say_status();
    now_us += TICK_US;
    memcpy(way[ticks % TICKS_MAX].bytes, robot.out, robot.length);
    way[ticks % TICKS_MAX].length = cut ? 0 : robot.length;
    ticks++;
    size_t came = (ticks - 1 - delay) % TICKS_MAX;
    if (!cut && way[came].length > 0)
        job->kind->received(job, way[came].bytes, way[came].length, now_us);
}

static void let_pass(int64_t us)
{
    for (int64_t end_us = now_us + us; now_us < end_us && update.job.state == JOB_WORKING;)
        tick();
}

static void until_written(unsigned pages)
{
    while (robot.writes < pages && update.job.state == JOB_WORKING)
        tick();
    TEST_ASSERT_EQUAL_INT(JOB_WORKING, update.job.state);
}

static void link_down(void)
{
    cut = true;
    update.job.kind->lost(&update.job, "somebody pulled the plug", now_us);
}

static void link_up(void)
{
    cut = false;
    update.job.kind->linked(&update.job, now_us);
}

static void ends(enum job_state state, const char *words)
{
    let_pass(600ll * SECOND_US);
    TEST_ASSERT_EQUAL_INT_MESSAGE(state, update.job.state, update.job.words);
    TEST_ASSERT_EQUAL_STRING(words, update.job.words);
}

static void begin_without_link(bool again, bool force)
{
    const struct update_options options = {again, force};

    update_begin(&update, &program, 3, &options);
    cut = true;
}

static void begin(bool again, bool force)
{
    begin_without_link(again, force);
    link_up();
}

void setUp(void)
{
    uint32_t state = 7;

    memset(&program, 0xFF, sizeof program);
    program.length = (PAGES - 1) * FLASH_PAGE_BYTES - 5;
    program.crc = NEW;
    program.baud = 115200;
    for (unsigned i = 0; i < program.length; i++)
        program.slot[i] = (uint8_t)random_next(&state);
    memset(program.slot + SEAL_AT, 0x5A, SLOT_BYTES - SEAL_AT);

    robot = (struct robot){.id = 3, .runs = OLD, .asks = true, .signature = {0x1E, 0x97, 0x02}};
    memset(robot.stage, 0xFF, sizeof robot.stage);
    frame_decoder_init(&robot.decoder);
    memset(way, 0, sizeof way);
    delay = 0;
    now_us = 1000;
}

void tearDown(void)
{
}

/* ---- tests ----------------------------------------------------------------------------- */

static void test_a_robot_gets_another_program(void)
{
    begin(false, false);
    ends(JOB_DONE, "0123ABCD -> 89ABCDEF, verified, runs");
    TEST_ASSERT_EQUAL_HEX8_ARRAY(program.slot, robot.stage, SLOT_BYTES);
    TEST_ASSERT_EQUAL_UINT(PAGES, robot.writes);
    TEST_ASSERT_EQUAL_UINT(PAGES + 1, robot.reads); /* each, and the first one before */
    TEST_ASSERT_EQUAL_UINT(0, update.talk.lost);    /* words for a loader have spoiled no frame */
    TEST_ASSERT_TRUE(update.job.progress == 1);
}

static void test_one_that_has_it_is_left_alone(void)
{
    robot.runs = NEW;
    begin(false, false);
    ends(JOB_DONE, "has 89ABCDEF already");
    TEST_ASSERT_EQUAL_UINT(0, robot.signed_on);
}

static void test_it_gets_it_again_when_that_is_wanted(void)
{
    robot.runs = NEW;
    begin(true, false);
    ends(JOB_DONE, "89ABCDEF -> 89ABCDEF, verified, runs");
    TEST_ASSERT_EQUAL_UINT(PAGES, robot.writes);
}

static void test_one_that_waits_in_its_loader_gets_it(void)
{
    robot.in_loader = true;
    begin(false, false);
    ends(JOB_DONE, "89ABCDEF, verified, runs");
}

static void test_one_on_a_mission_is_halted_first(void)
{
    robot.on_mission = true;
    begin(false, false);
    ends(JOB_DONE, "0123ABCD -> 89ABCDEF, verified, runs");
}

static void test_what_is_in_the_stage_is_not_sent_again(void)
{
    memcpy(robot.stage, program.slot, 10 * FLASH_PAGE_BYTES);
    begin(false, false);
    ends(JOB_DONE, "0123ABCD -> 89ABCDEF, verified, runs");
    TEST_ASSERT_EQUAL_UINT(PAGES - 10, robot.writes);
}

static void test_from_the_first_page_that_differs_all_are_written(void)
{
    memcpy(robot.stage, program.slot, SLOT_BYTES);
    robot.stage[3 * FLASH_PAGE_BYTES] ^= 1;
    begin(false, false);
    ends(JOB_DONE, "0123ABCD -> 89ABCDEF, verified, runs");
    TEST_ASSERT_EQUAL_UINT(PAGES - 3, robot.writes);
}

static void test_answers_that_are_lost_are_asked_for_again(void)
{
    for (robot.mute = 3; robot.mute < 12; robot.mute++) {
        unsigned mute = robot.mute;

        setUp();
        robot.mute = mute;
        begin(false, false);
        ends(JOB_DONE, "0123ABCD -> 89ABCDEF, verified, runs");
        TEST_ASSERT_EQUAL_HEX8_ARRAY(program.slot, robot.stage, SLOT_BYTES);
    }
}

/* Far slower than the usual one, the link needs more time and nothing else. */
static void test_a_slow_link_will_do(void)
{
    for (unsigned slow = 1; slow <= 14; slow++) {
        setUp();
        delay = slow;
        begin(false, false);
        ends(JOB_DONE, "0123ABCD -> 89ABCDEF, verified, runs");
    }
}

static void test_a_link_that_comes_back_is_gone_on_with(void)
{
    begin(false, false);
    until_written(8);
    link_down();
    let_pass(40 * SECOND_US);
    link_up();
    ends(JOB_DONE, "0123ABCD -> 89ABCDEF, verified, runs");
    TEST_ASSERT_TRUE(robot.writes <= PAGES + 1);
}

static void test_a_link_that_comes_late_is_waited_for(void)
{
    begin_without_link(false, false);
    let_pass(40 * SECOND_US);
    link_up();
    ends(JOB_DONE, "0123ABCD -> 89ABCDEF, verified, runs");
}

/* What comes and goes without a page between is no going on. */
static void test_a_link_that_comes_and_goes_is_not_waited_for_for_ever(void)
{
    robot.deaf = true;
    begin(false, false);
    for (int i = 0; i < 100 && update.job.state == JOB_WORKING; i++) {
        let_pass(SECOND_US);
        link_down();
        let_pass(SECOND_US);
        link_up();
    }
    TEST_ASSERT_EQUAL_INT(JOB_FAILED, update.job.state);
    TEST_ASSERT_TRUE(now_us < 3 * UPDATE_PATIENCE_US);
}

static void test_a_robot_that_starts_anew_is_gone_on_with(void)
{
    begin(false, false);
    until_written(8);
    robot.in_loader = false;
    robot.status_us = now_us;
    ends(JOB_DONE, "0123ABCD -> 89ABCDEF, verified, runs");
    TEST_ASSERT_TRUE(robot.writes <= PAGES + 1);
}

/* It has no program that is whole, and nobody sees that it was reset. */
static void test_a_loader_that_starts_anew_is_gone_on_with(void)
{
    robot.in_loader = true;
    begin(false, false);
    until_written(8);
    robot.listens = false;
    ends(JOB_DONE, "89ABCDEF, verified, runs");
    TEST_ASSERT_EQUAL_UINT(2, robot.signed_on);
    TEST_ASSERT_TRUE(robot.writes <= PAGES + 1);
}

static void test_a_link_that_stays_down_is_told(void)
{
    begin(false, false);
    until_written(8);
    link_down();
    ends(JOB_FAILED,
         "link down: somebody pulled the plug; it still has 0123ABCD, which runs again in 10 s");
}

static void test_whole_in_its_stage_it_needs_the_link_no_more(void)
{
    begin(false, false);
    until_written(PAGES);
    let_pass(SECOND_US / 2);
    link_down();
    ends(JOB_FAILED, "link down: somebody pulled the plug; it has 89ABCDEF, which it "
                     "installs by itself");
}

static void test_a_silent_one_is_told(void)
{
    robot.off = true;
    begin(false, false);
    ends(JOB_FAILED, "does not answer: is it on, and its radio at 115200 baud?; it has the program "
                     "that it had");
    TEST_ASSERT_TRUE(now_us > UPDATE_PATIENCE_US);
}

static void test_one_that_falls_silent_in_its_loader_is_told(void)
{
    begin(false, false);
    until_written(8);
    robot.deaf = true;
    ends(JOB_FAILED, "its boot loader does not answer any more; it still has 0123ABCD, which runs "
                     "again in 10 s");
}

/* Whatever it answers, it comes to no page. */
static void test_one_that_gets_nowhere_is_told(void)
{
    robot.mute = 2;
    begin(false, false);
    ends(JOB_FAILED, "its boot loader does not answer any more; it still has 0123ABCD, which runs "
                     "again in 10 s");
    TEST_ASSERT_TRUE(now_us < 2 * UPDATE_PATIENCE_US);
}

static void test_one_without_a_loader_is_told(void)
{
    begin(false, false);
    while (update.step != UPDATE_CALL)
        tick();
    robot.asks = false;
    ends(JOB_FAILED, "does not go to its boot loader: has it one? (`make flash'); it still has "
                     "0123ABCD, which runs");
}

/* A program from before MESSAGE_ASK; its loader listens when power comes. */
static void test_an_older_one_is_caught_when_it_is_switched_on(void)
{
    robot.asks = false;
    begin(false, false);
    let_pass(40 * SECOND_US);
    TEST_ASSERT_EQUAL_STRING("does not know the call: reset it now", update.job.words);
    robot.off = true;
    let_pass(2 * SECOND_US);
    robot.off = false;
    robot.in_loader = true;
    robot.asks = true; /* the new one does */
    ends(JOB_DONE, "89ABCDEF, verified, runs");
}

static void test_another_robot_is_refused(void)
{
    robot.id = 5;
    begin(false, false);
    ends(JOB_FAILED, "robot 5 answers there: mend the site file; --force updates it all the same");
    TEST_ASSERT_EQUAL_UINT(0, robot.signed_on);
}

static void test_another_robot_may_be_meant(void)
{
    robot.id = 5;
    begin(false, true);
    ends(JOB_DONE, "0123ABCD -> 89ABCDEF, verified, runs");
}

static void test_one_without_an_id_is_updated(void)
{
    robot.id = 0;
    begin(false, false);
    ends(JOB_DONE, "0123ABCD -> 89ABCDEF, verified, runs");
}

static void test_another_chip_is_not_written_to(void)
{
    robot.signature[1] = 0x98;
    begin(false, false);
    ends(JOB_FAILED, "is no ATmega128; it still has 0123ABCD, which runs again in 10 s");
    TEST_ASSERT_EQUAL_UINT(0, robot.writes);
}

static void test_a_page_that_does_not_keep_is_told(void)
{
    robot.worn = true;
    begin(false, false);
    ends(JOB_FAILED, "a page of its flash does not keep what is written to it; it still has "
                     "0123ABCD, which runs again in 10 s");
}

static void test_one_that_does_not_take_it_is_told(void)
{
    robot.refuses = true;
    begin(false, false);
    ends(JOB_FAILED, "does not take the update, though it was read back whole; it still has "
                     "0123ABCD, which runs");
    TEST_ASSERT_TRUE(robot.leaves > 1);
}

static void test_one_that_stays_in_its_loader_is_told(void)
{
    robot.stays = true;
    begin(false, false);
    ends(JOB_FAILED, "stays in its boot loader; it has 89ABCDEF, which it installs by itself");
    TEST_ASSERT_TRUE(robot.leaves > 1);
}

/* The stage was spoiled after it was read back. */
static void test_a_stage_that_was_not_taken_is_looked_at_again(void)
{
    begin(false, false);
    until_written(PAGES);
    robot.stage[5 * FLASH_PAGE_BYTES] ^= 1;
    ends(JOB_DONE, "0123ABCD -> 89ABCDEF, verified, runs");
    TEST_ASSERT_EQUAL_UINT(2, robot.leaves);
}

/* The same, and it is not whole until it has been written anew. */
static void test_a_stage_that_is_written_anew_is_not_whole(void)
{
    begin(false, false);
    until_written(PAGES);
    robot.stage[5 * FLASH_PAGE_BYTES] ^= 1;
    robot.stays = true;
    until_written(PAGES + 1);
    link_down();
    ends(JOB_FAILED,
         "link down: somebody pulled the plug; it still has 0123ABCD, which runs again in 10 s");
}

/* Patience is for one page, not for all of them. */
static void test_a_long_one_takes_its_time(void)
{
    program.length = 240 * FLASH_PAGE_BYTES;
    memset(program.slot, 0x55, program.length);
    begin(false, false);
    ends(JOB_DONE, "0123ABCD -> 89ABCDEF, verified, runs");
    TEST_ASSERT_TRUE(now_us > UPDATE_PATIENCE_US);
}

static void test_any_room_will_do(void)
{
    uint8_t bytes[8];

    for (size_t room = 0; room < sizeof bytes; room++) {
        memset(bytes, 0xEE, sizeof bytes);
        begin(false, false);
        for (int i = 0; i < 100; i++) {
            TEST_ASSERT_TRUE(update.job.kind->send(&update.job, i * TICK_US, bytes, room) <= room);
            TEST_ASSERT_EQUAL_HEX8(0xEE, bytes[room]);
        }
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_robot_gets_another_program);
    RUN_TEST(test_one_that_has_it_is_left_alone);
    RUN_TEST(test_it_gets_it_again_when_that_is_wanted);
    RUN_TEST(test_one_that_waits_in_its_loader_gets_it);
    RUN_TEST(test_one_on_a_mission_is_halted_first);
    RUN_TEST(test_what_is_in_the_stage_is_not_sent_again);
    RUN_TEST(test_from_the_first_page_that_differs_all_are_written);
    RUN_TEST(test_answers_that_are_lost_are_asked_for_again);
    RUN_TEST(test_a_slow_link_will_do);
    RUN_TEST(test_a_link_that_comes_back_is_gone_on_with);
    RUN_TEST(test_a_link_that_comes_late_is_waited_for);
    RUN_TEST(test_a_link_that_comes_and_goes_is_not_waited_for_for_ever);
    RUN_TEST(test_a_robot_that_starts_anew_is_gone_on_with);
    RUN_TEST(test_a_loader_that_starts_anew_is_gone_on_with);
    RUN_TEST(test_a_link_that_stays_down_is_told);
    RUN_TEST(test_whole_in_its_stage_it_needs_the_link_no_more);
    RUN_TEST(test_a_silent_one_is_told);
    RUN_TEST(test_one_that_falls_silent_in_its_loader_is_told);
    RUN_TEST(test_one_that_gets_nowhere_is_told);
    RUN_TEST(test_one_without_a_loader_is_told);
    RUN_TEST(test_an_older_one_is_caught_when_it_is_switched_on);
    RUN_TEST(test_another_robot_is_refused);
    RUN_TEST(test_another_robot_may_be_meant);
    RUN_TEST(test_one_without_an_id_is_updated);
    RUN_TEST(test_another_chip_is_not_written_to);
    RUN_TEST(test_a_page_that_does_not_keep_is_told);
    RUN_TEST(test_one_that_does_not_take_it_is_told);
    RUN_TEST(test_one_that_stays_in_its_loader_is_told);
    RUN_TEST(test_a_stage_that_was_not_taken_is_looked_at_again);
    RUN_TEST(test_a_stage_that_is_written_anew_is_not_whole);
    RUN_TEST(test_a_long_one_takes_its_time);
    RUN_TEST(test_any_room_will_do);
    return UNITY_END();
}
