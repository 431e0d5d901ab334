#include "roster.h"

#include <pty.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>
#include <unity.h>

#define COLUMNS 48
#define ROWS 6

/* stderr is a terminal, and what is shown on it comes here. */
static int terminal, before;
static struct roster roster;

void setUp(void)
{
    struct winsize size = {.ws_row = ROWS, .ws_col = COLUMNS};
    int slave;

    TEST_ASSERT_EQUAL_INT(0, openpty(&terminal, &slave, NULL, NULL, &size));
    before = dup(STDERR_FILENO);
    dup2(slave, STDERR_FILENO);
    close(slave);
    roster_begin(&roster, false);
}

void tearDown(void)
{
    dup2(before, STDERR_FILENO);
    close(before);
    close(terminal);
}

/* All of it: a terminal passes on what is written to it in its own time. */
static const char *shown(void)
{
    static const char end = '\a';
    static char text[4096];
    size_t count = 0;

    TEST_ASSERT_EQUAL(1, write(STDERR_FILENO, &end, 1));
    do {
        ssize_t more = read(terminal, text + count, sizeof text - count);

        TEST_ASSERT_TRUE(more > 0);
        count += (size_t)more;
    } while (text[count - 1] != end && count < sizeof text);
    text[count - 1] = '\0';
    return text;
}

static size_t count_of(const char *text, char c)
{
    size_t count = 0;

    for (; *text != '\0'; text++)
        count += *text == c;
    return count;
}

static void test_each_that_works_has_a_line_with_a_bar(void)
{
    const struct roster_line lines[] = {{"robot 3", 0.5, "sends"}, {"robot 12", 1, "reads"}};

    roster_draw(&roster, lines, 2);
    const char *text = shown();
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(text, "robot 3     [##########..........]  50 %"), text);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(text, "robot 12    [####################] 100 %"), text);
    TEST_ASSERT_EQUAL_UINT(2, roster.drawn);
}

static void test_lines_are_drawn_over_those_before(void)
{
    const struct roster_line lines[] = {{"robot 3", 0, "a"}, {"robot 4", 0, "b"}};

    roster_draw(&roster, lines, 2);
    shown();
    roster_draw(&roster, lines, 1);
    TEST_ASSERT_EQUAL_INT(0, strncmp(shown(), "\033[2A\r", 5));
    roster_end(&roster);
    TEST_ASSERT_EQUAL_STRING("\033[1A\r\033[J", shown());
    TEST_ASSERT_EQUAL_UINT(0, roster.drawn);
}

static void test_no_more_is_drawn_than_the_terminal_has_room_for(void)
{
    struct roster_line lines[10];

    for (size_t i = 0; i < 10; i++)
        lines[i] =
            (struct roster_line){"robot 1", 0, "words that are far too long for any line here"};
    roster_draw(&roster, lines, 10);
    const char *text = shown();
    TEST_ASSERT_EQUAL_UINT(ROWS - 1, count_of(text, '\n'));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(text, "and 6 more"), text);
    TEST_ASSERT_EQUAL_UINT(COLUMNS - 1, strcspn(text, "\033"));
}

static void test_what_is_said_stays_above(void)
{
    const struct roster_line line = {"robot 3", 0, "a"};

    roster_draw(&roster, &line, 1);
    shown();
    roster_say(&roster, "robot %d: done", 4);
    TEST_ASSERT_EQUAL_STRING("\033[1A\r\033[Jrobot 4: done\r\n", shown());
    TEST_ASSERT_EQUAL_UINT(0, roster.drawn);
}

static void test_a_quiet_one_draws_nothing(void)
{
    const struct roster_line line = {"robot 3", 0, "a"};

    roster_begin(&roster, true);
    roster_draw(&roster, &line, 1);
    TEST_ASSERT_EQUAL_STRING("", shown());
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_each_that_works_has_a_line_with_a_bar);
    RUN_TEST(test_lines_are_drawn_over_those_before);
    RUN_TEST(test_no_more_is_drawn_than_the_terminal_has_room_for);
    RUN_TEST(test_what_is_said_stays_above);
    RUN_TEST(test_a_quiet_one_draws_nothing);
    return UNITY_END();
}
