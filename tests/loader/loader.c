/* loader.c: the boot loader with a chip around it, byte by byte. */
#include "atmega128.h"
#include "flash_map.h"
#include "message.h"
#include "orders.h"
#include "station.h"

#include <string.h>
#include <unity.h>

enum { POWER_ON = 1, EXTERNAL = 2, WATCHDOG = 8, RESTART = 0 };
enum { CMD_OK = 0x00, CMD_FAILED = 0xC0, CMD_UNKNOWN = 0xC9 };

#define WINDOW_US 1000000
#define SILENCE_US 10000000

/* Both slots are checked and an update is installed by then. */
#define BOOT_US 200000

static struct avr_image *loader, *program_a, *program_b, *muster;
static struct station station;

void setUp(void)
{
    station_begin(&station, loader, program_a);
}

void tearDown(void)
{
    station_end(&station);
}

/* ---- what the tests share -------------------------------------------------------------- */

/* It starts within `us` and tells why it was reset. */
static void assert_runs(char name, uint8_t cause, uint32_t us)
{
    TEST_ASSERT_EQUAL_INT(name, station_hear(&station, us));
    TEST_ASSERT_EQUAL_INT(cause, station_hear(&station, BOOT_US));
}

static void assert_silent(uint32_t us)
{
    TEST_ASSERT_EQUAL_INT(-1, station_hear(&station, us));
}

static void start_program(void)
{
    station_power_on(&station);
    assert_runs('a', POWER_ON, WINDOW_US + BOOT_US);
}

static void order(uint8_t order)
{
    station_send(&station, &order, 1);
}

static void send_random(uint32_t *state, int count)
{
    for (; count > 0; count--) {
        *state = *state * 1664525u + 1013904223u;
        station_send(&station, &(uint8_t){(uint8_t)(*state >> 24)}, 1);
    }
}

static int load_address(uint16_t words)
{
    uint8_t body[] = {0x06, 0, 0, (uint8_t)(words >> 8), (uint8_t)words};

    return station_command(&station, body, sizeof body);
}

static int read_flash(uint16_t count)
{
    uint8_t body[] = {0x14, (uint8_t)(count >> 8), (uint8_t)count, 0x20};

    return station_command(&station, body, sizeof body);
}

/* The last byte of what the chip answers to an instruction of serial programming. */
static uint8_t spi_multi(uint8_t a, uint8_t b, uint8_t c)
{
    uint8_t body[] = {0x1D, 4, 4, 0, a, b, c, 0};

    TEST_ASSERT_EQUAL_INT(CMD_OK, station_command(&station, body, sizeof body));
    TEST_ASSERT_EQUAL_UINT16(7, station.length);
    TEST_ASSERT_EQUAL_HEX8(a, station.answer[3]);
    TEST_ASSERT_EQUAL_HEX8(b, station.answer[4]);
    TEST_ASSERT_EQUAL_HEX8(CMD_OK, station.answer[6]);
    return station.answer[5];
}

static void sign_on(void)
{
    station_power_on(&station);
    TEST_ASSERT_TRUE(station_sign_on(&station));
}

/* ---- resets ---------------------------------------------------------------------------- */

static void test_after_power_on_a_second_passes_and_the_program_runs(void)
{
    station_power_on(&station);
    assert_silent(WINDOW_US * 9 / 10);
    assert_runs('a', POWER_ON, WINDOW_US / 5);
}

static void test_after_an_external_reset_as_well(void)
{
    start_program();
    avr_core_reset(station.core);
    assert_silent(WINDOW_US * 9 / 10);
    assert_runs('a', EXTERNAL, WINDOW_US / 5);
}

static void test_after_a_reset_by_the_watchdog_the_program_runs_at_once(void)
{
    start_program();
    order(ORDER_HANG);
    assert_runs('a', WATCHDOG, 250000 + 50000);
}

static void test_the_robots_program_is_checked_within_100_ms(void)
{
    const uint8_t listening = UCSRB_RXEN;
    uint32_t ms = 0;

    own_flash_put_program(station.flash, muster);
    station_power_on(&station);
    while (!(avr_core_data(station.core)[UCSR0B] & listening) && ms < 1000)
        ms += station_run_us(&station, 1000);
    TEST_ASSERT_LESS_THAN(100, ms);
}

static void test_an_empty_slot_is_listened_for_for_ever(void)
{
    memset(station.flash->bytes, 0xFF, SLOT_BYTES);
    station_power_on(&station);
    assert_silent(3 * SILENCE_US);
    TEST_ASSERT_TRUE(station_update(&station, program_b));
    assert_runs('b', RESTART, BOOT_US);
}

static void test_a_program_with_one_bit_wrong_is_not_started(void)
{
    station.flash->bytes[100] ^= 4;
    station_power_on(&station);
    assert_silent(2 * WINDOW_US);
    TEST_ASSERT_TRUE(station_sign_on(&station));
}

/* ---- updates --------------------------------------------------------------------------- */

static void test_a_program_is_replaced(void)
{
    sign_on();
    TEST_ASSERT_TRUE(station_update(&station, program_b));
    assert_runs('b', RESTART, BOOT_US);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(program_b->flash, station.flash->bytes, SLOT_BYTES);
}

static void test_it_is_installed_once(void)
{
    sign_on();
    TEST_ASSERT_TRUE(station_update(&station, program_b));
    assert_runs('b', RESTART, BOOT_US);
    unsigned operations = station.flash->operations;
    station_power_off(&station);
    station_power_on(&station);
    assert_runs('b', POWER_ON, WINDOW_US + BOOT_US);
    TEST_ASSERT_EQUAL_UINT(operations, station.flash->operations);
}

static void test_a_running_program_calls_the_loader(void)
{
    start_program();
    order(ORDER_CALL);
    TEST_ASSERT_TRUE(station_update(&station, program_b));
    assert_runs('b', RESTART, BOOT_US);
}

static void test_called_in_vain_it_goes_back(void)
{
    start_program();
    order(ORDER_CALL);
    assert_silent(SILENCE_US * 9 / 10);
    assert_runs('a', RESTART, SILENCE_US / 5);
}

static void test_a_session_ends_by_silence(void)
{
    sign_on();
    for (int i = 0; i < 3; i++) {
        assert_silent(SILENCE_US * 9 / 10);
        TEST_ASSERT_EQUAL_INT(CMD_OK, load_address(0));
    }
    assert_silent(SILENCE_US * 9 / 10);
    assert_runs('a', RESTART, SILENCE_US / 5);
}

/* The seal of the one and pages of the other never come together. */
static void test_half_an_update_leaves_the_old_program(void)
{
    sign_on();
    TEST_ASSERT_TRUE(station_update(&station, program_b));
    assert_runs('b', RESTART, BOOT_US);
    order(ORDER_CALL);
    TEST_ASSERT_TRUE(station_sign_on(&station));
    TEST_ASSERT_EQUAL_INT(CMD_OK, station_write_page(&station, 0, program_a->flash, 256));
    TEST_ASSERT_EACH_EQUAL_HEX8(0xFF, station.flash->bytes + STAGE_START + SEAL_AT, 8);
    station_power_off(&station);
    station_power_on(&station);
    assert_runs('b', POWER_ON, WINDOW_US + BOOT_US);
}

static void test_the_stage_reads_as_it_was_written(void)
{
    sign_on();
    TEST_ASSERT_EQUAL_INT(CMD_OK, station_write_page(&station, 512, program_b->flash, 256));
    TEST_ASSERT_EQUAL_INT(CMD_OK, station_write_page(&station, 768, program_b->flash, 10));
    TEST_ASSERT_EQUAL_INT(CMD_OK, load_address(256));
    TEST_ASSERT_EQUAL_INT(CMD_OK, read_flash(256));
    TEST_ASSERT_EQUAL_UINT16(259, station.length);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(program_b->flash, station.answer + 2, 256);
    TEST_ASSERT_EQUAL_HEX8(CMD_OK, station.answer[258]);
    /* The address has moved on. */
    TEST_ASSERT_EQUAL_INT(CMD_OK, read_flash(12));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(program_b->flash, station.answer + 2, 10);
    TEST_ASSERT_EQUAL_HEX8(0xFF, station.answer[12]);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(program_b->flash, station.flash->bytes + STAGE_START + 512, 256);
}

static void test_the_last_bytes_of_the_stage_can_be_read(void)
{
    sign_on();
    TEST_ASSERT_EQUAL_INT(CMD_OK, load_address(SEAL_AT / 2));
    TEST_ASSERT_EQUAL_INT(CMD_FAILED, read_flash(9));
    TEST_ASSERT_EQUAL_INT(CMD_OK, read_flash(8));
    TEST_ASSERT_EQUAL_INT(CMD_FAILED, read_flash(1));
}

static void assert_same_but_for_the_stage(const uint8_t *before)
{
    TEST_ASSERT_EQUAL_HEX8_ARRAY(before, station.flash->bytes, SLOT_BYTES);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(before + LOADER_START, station.flash->bytes + LOADER_START,
                                 FLASH_BYTES - LOADER_START);
}

static void test_nothing_is_written_beyond_the_stage(void)
{
    static uint8_t before[FLASH_BYTES];

    memcpy(before, station.flash->bytes, sizeof before);
    sign_on();
    for (uint32_t at = SLOT_BYTES; at < 0x20000; at += FLASH_PAGE_BYTES) {
        uint8_t body[10 + FLASH_PAGE_BYTES] = {0x13, 1, 0};

        TEST_ASSERT_EQUAL_INT(CMD_OK, load_address((uint16_t)(at / 2)));
        TEST_ASSERT_EQUAL_INT(CMD_FAILED, read_flash(2));
        TEST_ASSERT_EQUAL_INT(CMD_FAILED, station_command(&station, body, sizeof body));
    }
    TEST_ASSERT_EQUAL_UINT(0, station.flash->operations);
    assert_same_but_for_the_stage(before);
}

static void test_no_page_is_written_but_a_page(void)
{
    static const uint16_t lengths[] = {10, 265, 11};
    uint8_t body[10 + FLASH_PAGE_BYTES] = {0x13, 1, 0};

    sign_on();
    TEST_ASSERT_EQUAL_INT(CMD_FAILED, station_write_page(&station, 2, program_b->flash, 256));
    TEST_ASSERT_EQUAL_INT(CMD_FAILED, station_write_page(&station, 0, program_b->flash, 0));
    TEST_ASSERT_EQUAL_INT(CMD_OK, load_address(0));
    for (int i = 0; i < 3; i++)
        TEST_ASSERT_EQUAL_INT(CMD_FAILED, station_command(&station, body, lengths[i]));
    TEST_ASSERT_EQUAL_INT(CMD_FAILED, read_flash(257));
    TEST_ASSERT_EQUAL_INT(CMD_FAILED, read_flash(0));
    TEST_ASSERT_EQUAL_UINT(0, station.flash->operations);
}

/* ---- what a programmer asks besides ---------------------------------------------------- */

static void test_it_says_what_it_is(void)
{
    sign_on();
    TEST_ASSERT_EQUAL_UINT16(11, station.length);
    TEST_ASSERT_EQUAL_HEX8_ARRAY("\bAVRISP_2", station.answer + 2, 9);
}

static void test_signature_and_fuses_are_the_chip_s(void)
{
    sign_on();
    TEST_ASSERT_EQUAL_HEX8(0x1E, spi_multi(0x30, 0, 0));
    TEST_ASSERT_EQUAL_HEX8(0x97, spi_multi(0x30, 0, 1));
    TEST_ASSERT_EQUAL_HEX8(0x02, spi_multi(0x30, 0, 2));
    TEST_ASSERT_EQUAL_HEX8(0x3F, spi_multi(0x50, 0, 0));
    TEST_ASSERT_EQUAL_HEX8(0x84, spi_multi(0x58, 8, 0));
    TEST_ASSERT_EQUAL_HEX8(0xFF, spi_multi(0x50, 8, 0));
    TEST_ASSERT_EQUAL_HEX8(0xEF, spi_multi(0x58, 0, 0));
}

/* avrdude asks so. */
static void test_single_bytes_are_read_as_well(void)
{
    static const uint8_t signature[] = {0x1E, 0x97, 0x02};

    sign_on();
    for (uint8_t i = 0; i < sizeof signature; i++) {
        uint8_t body[] = {0x1B, 4, 0x30, 0, i, 0};

        TEST_ASSERT_EQUAL_INT(CMD_OK, station_command(&station, body, sizeof body));
        TEST_ASSERT_EQUAL_UINT16(4, station.length);
        TEST_ASSERT_EQUAL_HEX8(signature[i], station.answer[2]);
        TEST_ASSERT_EQUAL_HEX8(CMD_OK, station.answer[3]);
    }
    TEST_ASSERT_EQUAL_INT(CMD_OK,
                          station_command(&station, (uint8_t[]){0x18, 4, 0x58, 8, 0, 0}, 6));
    TEST_ASSERT_EQUAL_HEX8(0x84, station.answer[2]);
    TEST_ASSERT_EQUAL_INT(CMD_OK,
                          station_command(&station, (uint8_t[]){0x1A, 4, 0x58, 0, 0, 0}, 6));
    TEST_ASSERT_EQUAL_HEX8(0xEF, station.answer[2]);
}

static void test_parameters_and_modes_are_taken(void)
{
    sign_on();
    TEST_ASSERT_EQUAL_INT(CMD_OK, station_command(&station, (uint8_t[]){0x02, 0x98, 1}, 3));
    TEST_ASSERT_EQUAL_INT(CMD_OK, station_command(&station, (uint8_t[]){0x03, 0x98}, 2));
    TEST_ASSERT_EQUAL_UINT16(3, station.length);
    TEST_ASSERT_EQUAL_INT(CMD_OK, station_command(&station, (uint8_t[12]){0x10}, 12));
}

static void test_the_eeprom_cannot_be_reached(void)
{
    uint8_t before[64], after[64];

    station_power_on(&station);
    memset(before, 0x5A, sizeof before);
    avr_core_write_eeprom(station.core, 0, before, sizeof before);
    TEST_ASSERT_TRUE(station_sign_on(&station));
    TEST_ASSERT_EQUAL_INT(CMD_OK, load_address(0));
    TEST_ASSERT_EQUAL_INT(CMD_UNKNOWN, station_command(&station, (uint8_t[14]){0x15, 0, 4}, 14));
    TEST_ASSERT_EQUAL_INT(CMD_UNKNOWN, station_command(&station, (uint8_t[]){0x16, 0, 4, 0}, 4));
    TEST_ASSERT_TRUE(station_update(&station, program_b));
    assert_runs('b', RESTART, BOOT_US);
    avr_core_read_eeprom(station.core, 0, after, sizeof after);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(before, after, sizeof after);
}

/* ---- what is on the link besides ------------------------------------------------------- */

static void test_a_wrong_sum_is_not_answered(void)
{
    static const uint8_t sign_on_with_wrong_sum[] = {0x1B, 1, 0, 1, 0x0E, 0x01, 0x15};

    sign_on();
    station_send(&station, sign_on_with_wrong_sum, sizeof sign_on_with_wrong_sum);
    assert_silent(50000);
    TEST_ASSERT_EQUAL_INT(CMD_OK, load_address(0));
}

static void test_a_message_that_is_too_long_is_none(void)
{
    static const uint8_t head[] = {0x1B, 1, 0x01, 0x0B, 0x0E};

    sign_on();
    station_send(&station, head, sizeof head);
    TEST_ASSERT_EQUAL_INT(CMD_OK, load_address(0));
}

static void test_a_message_cut_short_is_forgotten_after_a_pause(void)
{
    static const uint8_t head[] = {0x1B, 1, 0x01, 0x0A, 0x0E, 0x13, 1, 0};

    sign_on();
    station_send(&station, head, sizeof head);
    assert_silent(150000);
    TEST_ASSERT_EQUAL_INT(CMD_OK, load_address(0));
}

static void test_it_is_heard_right_after_noise(void)
{
    uint32_t state = 1;

    station_power_on(&station);
    station_run_us(&station, 50000);
    for (int i = 0; i < 20; i++) {
        uint8_t start = 0x1B;

        send_random(&state, 23);
        station_send(&station, &start, 1);
        TEST_ASSERT_EQUAL_INT(CMD_OK, station_command(&station, (uint8_t[]){0x01}, 1));
        station_power_off(&station);
        station_power_on(&station);
        station_run_us(&station, 50000);
    }
}

/* A frame of the mission, of any kind and with anything in it. */
static void send_frame(uint32_t *state)
{
    static const uint8_t types[] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 16, 17, 18};
    uint8_t payload[FRAME_PAYLOAD_MAX], frame[FRAME_BYTES_MAX];
    uint8_t length = (uint8_t)(1 + (*state >> 8) % FRAME_PAYLOAD_MAX);

    for (int i = 0; i < length; i++) {
        *state = *state * 1664525u + 1013904223u;
        /* Often what would begin a message. */
        payload[i] = *state >> 31 ? (uint8_t)(*state >> 20)
                                  : (uint8_t[]){0x1B, 0, 1, 0x0E}[*state >> 24 & 3];
    }
    payload[0] = types[(*state >> 16) % sizeof types];
    station_send(&station, frame, frame_encode(frame, payload, length));
}

static void test_frames_of_a_mission_mean_nothing_to_it(void)
{
    uint32_t state = 1;

    station_power_on(&station);
    for (int i = 0; i < 180; i++)
        send_frame(&state);
    assert_silent(20000);
    TEST_ASSERT_TRUE(station_sign_on(&station));
    for (int i = 0; i < 1000; i++)
        send_frame(&state);
    assert_silent(150000);
    TEST_ASSERT_EQUAL_UINT(0, station.flash->operations);
    TEST_ASSERT_EQUAL_INT(CMD_OK, load_address(0));
}

static void test_a_programmer_is_heard_among_frames_of_a_mission(void)
{
    uint32_t state = 1;

    for (int i = 0; i < 30; i++) {
        station_power_on(&station);
        station_run_us(&station, 50000);
        for (int frames = 20; frames > 0; frames--)
            send_frame(&state);
        TEST_ASSERT_EQUAL_INT(CMD_OK, station_command(&station, (uint8_t[]){0x01}, 1));
        station_power_off(&station);
    }
}

static void test_frames_of_a_mission_do_not_hold_the_program_up(void)
{
    uint32_t state = 1;
    uint64_t start;
    uint8_t said = 0;

    station_power_on(&station);
    start = avr_core_cycle(station.core);
    while (avr_core_take_sent(station.core, &said, 1) == 0) {
        TEST_ASSERT_LESS_THAN_UINT64(2ull * loader->f_cpu, avr_core_cycle(station.core) - start);
        send_frame(&state);
    }
    TEST_ASSERT_EQUAL_HEX8('a', said);
}

/* ---- power ----------------------------------------------------------------------------- */

/* An update to B, with the power cut amid operation `first`, and amid the one `second` after the
 * next power-on; 0: not. Both times it is switched on again. */
static char update_amid_power_cuts(unsigned first, unsigned second)
{
    char said[100];
    int name;

    station_power_on(&station);
    station.cut_at = first;
    if (station_update(&station, program_b))
        station_run_us(&station, BOOT_US);
    station_power_off(&station);

    station.cut_at = second == 0 ? 0 : station.flash->operations + second;
    station_power_on(&station);
    station_run_us(&station, BOOT_US);
    station_power_off(&station);

    station.cut_at = 0;
    station_power_on(&station);
    snprintf(said, sizeof said, "power cut amid operation %u, then %u", first, second);
    name = station_hear(&station, WINDOW_US + BOOT_US);
    TEST_ASSERT_EQUAL_INT_MESSAGE(POWER_ON, station_hear(&station, BOOT_US), said);
    return (char)name;
}

static unsigned operations_of_an_update(void)
{
    unsigned operations;

    TEST_ASSERT_EQUAL_HEX8('b', update_amid_power_cuts(0, 0));
    operations = station.flash->operations;
    station_end(&station);
    return operations;
}

/* The stage takes the first half of them, the seal's page is erased one time more. */
static void test_wherever_power_is_cut_one_of_the_programs_is_whole(void)
{
    unsigned operations = operations_of_an_update();
    unsigned staged = operations / 2 + 1;

    TEST_ASSERT_EQUAL_UINT(1, operations % 2);
    for (unsigned cut = 1; cut <= operations; cut++) {
        station_begin(&station, loader, program_a);
        TEST_ASSERT_EQUAL_HEX8(cut <= staged ? 'a' : 'b', update_amid_power_cuts(cut, 0));
        TEST_ASSERT_EQUAL_HEX8_ARRAY(cut <= staged ? program_a->flash : program_b->flash,
                                     station.flash->bytes, SLOT_BYTES);
        station_end(&station);
    }
    setUp();
}

static void test_also_when_it_is_cut_again_while_that_is_made_good(void)
{
    unsigned operations = operations_of_an_update();

    for (unsigned first = operations / 2 + 2; first <= operations; first++) {
        station_begin(&station, loader, program_a);
        TEST_ASSERT_EQUAL_HEX8('b', update_amid_power_cuts(first, 1 + first * 7 % 12));
        TEST_ASSERT_EQUAL_HEX8_ARRAY(program_b->flash, station.flash->bytes, SLOT_BYTES);
        station_end(&station);
    }
    setUp();
}

/* ---- whole robots ---------------------------------------------------------------------- */

static void test_programs_that_it_would_not_run_are_refused(void)
{
    static uint8_t blank[FLASH_BYTES];
    struct avr_image slow = *program_a, unsealed = *program_a;

    slow.baud = 9600;
    unsealed.flash = blank;
    TEST_ASSERT_NULL(robot_loader_refuses(program_a, loader));
    TEST_ASSERT_NOT_NULL(strstr(robot_loader_refuses(&slow, loader), "baud rate"));
    TEST_ASSERT_NOT_NULL(strstr(robot_loader_refuses(&unsealed, loader), "no seal"));
}

int main(int argc, char **argv)
{
    (void)argc;
    loader = station_open(argv[1]);
    program_a = station_open(argv[2]);
    program_b = station_open(argv[3]);
    muster = station_open(argv[4]);
    UNITY_BEGIN();
    RUN_TEST(test_after_power_on_a_second_passes_and_the_program_runs);
    RUN_TEST(test_after_an_external_reset_as_well);
    RUN_TEST(test_after_a_reset_by_the_watchdog_the_program_runs_at_once);
    RUN_TEST(test_the_robots_program_is_checked_within_100_ms);
    RUN_TEST(test_an_empty_slot_is_listened_for_for_ever);
    RUN_TEST(test_a_program_with_one_bit_wrong_is_not_started);
    RUN_TEST(test_a_program_is_replaced);
    RUN_TEST(test_it_is_installed_once);
    RUN_TEST(test_a_running_program_calls_the_loader);
    RUN_TEST(test_called_in_vain_it_goes_back);
    RUN_TEST(test_a_session_ends_by_silence);
    RUN_TEST(test_half_an_update_leaves_the_old_program);
    RUN_TEST(test_the_stage_reads_as_it_was_written);
    RUN_TEST(test_the_last_bytes_of_the_stage_can_be_read);
    RUN_TEST(test_nothing_is_written_beyond_the_stage);
    RUN_TEST(test_no_page_is_written_but_a_page);
    RUN_TEST(test_it_says_what_it_is);
    RUN_TEST(test_signature_and_fuses_are_the_chip_s);
    RUN_TEST(test_single_bytes_are_read_as_well);
    RUN_TEST(test_parameters_and_modes_are_taken);
    RUN_TEST(test_the_eeprom_cannot_be_reached);
    RUN_TEST(test_a_wrong_sum_is_not_answered);
    RUN_TEST(test_a_message_that_is_too_long_is_none);
    RUN_TEST(test_a_message_cut_short_is_forgotten_after_a_pause);
    RUN_TEST(test_it_is_heard_right_after_noise);
    RUN_TEST(test_frames_of_a_mission_mean_nothing_to_it);
    RUN_TEST(test_a_programmer_is_heard_among_frames_of_a_mission);
    RUN_TEST(test_frames_of_a_mission_do_not_hold_the_program_up);
    RUN_TEST(test_wherever_power_is_cut_one_of_the_programs_is_whole);
    RUN_TEST(test_also_when_it_is_cut_again_while_that_is_made_good);
    RUN_TEST(test_programs_that_it_would_not_run_are_refused);
    avr_image_close(loader);
    avr_image_close(program_a);
    avr_image_close(program_b);
    avr_image_close(muster);
    return UNITY_END();
}
