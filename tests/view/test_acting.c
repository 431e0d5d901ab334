/* test_acting.c: what comes of what viewers say: an act of a good request, and of anything else
 * nothing, while others look on. */
#include "viewed.h"

#include "random.h"

#include <stdio.h>
#include <string.h>
#include <unity.h>

#define MUTATIONS 1000

static struct viewed viewed;
static struct client client, other;

void setUp(void)
{
    viewed_open(&viewed, (1u << ACT_COUNT) - 1);
    viewed_join(&viewed, &client);
}

void tearDown(void)
{
    client_close(&client);
    client_close(&other);
    viewed_close(&viewed);
}

/* What has been asked for so far has come to nothing: the next act is that of a good request of
 * somebody else's, and there is no other. */
static void assert_no_act(void)
{
    static unsigned number = 1000;
    struct act act;

    viewed_join(&viewed, &other);
    viewed_ask(&viewed, &other, ++number, "\"estop\"");
    act = viewed_act(&viewed);
    TEST_ASSERT_EQUAL_INT(ACT_ESTOP, act.kind);
    TEST_ASSERT_EQUAL_UINT32(number, act.number);
    TEST_ASSERT_FALSE(view_next_act(viewed.view, &act));
    client_close(&other);
}

static void expect_refusal(unsigned number, const char *words)
{
    char text[500], begin[100];

    viewed_text(&client, text, sizeof text);
    snprintf(begin, sizeof begin, "{\"answer\":{\"number\":%u,\"refused\":\"", number);
    TEST_ASSERT_EQUAL_INT_MESSAGE(0, strncmp(text, begin, strlen(begin)), text);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(text, words), text);
}

static void test_a_request_is_its_act_and_its_answer_the_askers(void)
{
    struct act act, second;

    viewed_join(&viewed, &other);
    viewed_ask(&viewed, &client, 7, "\"move\",\"robot\":3,\"x\":1.5,\"y\":-2.25,\"theta\":0.5");
    act = viewed_act(&viewed);
    TEST_ASSERT_EQUAL_INT(ACT_MOVE, act.kind);
    TEST_ASSERT_EQUAL_UINT(3, act.robot);
    TEST_ASSERT_EQUAL_DOUBLE(1.5, act.pose.x);
    TEST_ASSERT_EQUAL_DOUBLE(-2.25, act.pose.y);
    TEST_ASSERT_EQUAL_DOUBLE(0.5, act.pose.theta);
    viewed_ask(&viewed, &other, 7, "\"estop\"");
    second = viewed_act(&viewed);
    view_answer(viewed.view, &second, "not \"now\"");
    viewed_expect(&other, "{\"answer\":{\"number\":7,\"refused\":\"not \\\"now\\\"\"}}");
    view_answer(viewed.view, &act, NULL);
    viewed_expect(&client, "{\"answer\":{\"number\":7,\"refused\":null}}");
    client_close(&other);
    view_answer(viewed.view, &second, NULL); /* he is gone */
    assert_no_act();
}

static void test_acts_keep_their_order(void)
{
    for (unsigned i = 1; i <= 50; i++)
        viewed_ask(&viewed, &client, i, i % 2 == 0 ? "\"pause\"" : "\"resume\"");
    for (unsigned i = 1; i <= 50; i++) {
        struct act act = viewed_act(&viewed);

        TEST_ASSERT_EQUAL_UINT32(i, act.number);
        TEST_ASSERT_EQUAL_INT(i % 2 == 0 ? ACT_PAUSE : ACT_RESUME, act.kind);
    }
}

static void test_without_the_token_nothing_happens(void)
{
    static const char *const tokens[] = {"", "\"token\":\"\",", "\"token\":null,",
                                         "\"token\":\"0123456789abcdef0123456789abcdef\","};
    char text[300];

    for (unsigned i = 0; i < sizeof tokens / sizeof tokens[0]; i++) {
        snprintf(text, sizeof text, "{\"number\":%u,%s\"act\":\"kill\",\"robot\":3}", i, tokens[i]);
        client_send_text(&client, text);
        expect_refusal(i, "token");
    }
    assert_no_act();
}

static void test_what_is_no_request_is_passed_over(void)
{
    client_send_text(&client, "");
    client_send_text(&client, "{");
    client_send_text(&client, "[[[[[[[[");
    client_send_text(&client, "{\"token\":1}");
    viewed_ask(&viewed, &client, 1, "\"dance\"");
    expect_refusal(1, "no such act");
    viewed_ask(&viewed, &client, 2, "\"kill\",\"robot\":\"3\"");
    expect_refusal(2, "kill needs");
    assert_no_act();
}

/* The system may throw away the last words to someone whose own have not all been read. */
static void expect_end(unsigned code)
{
    struct client_message message;

    do
        message = client_receive(&client);
    while (message.opcode != CLIENT_CLOSE && message.opcode != CLIENT_GONE);
    if (message.opcode == CLIENT_CLOSE)
        TEST_ASSERT_EQUAL_UINT(code, message.bytes[0] << 8 | message.bytes[1]);
}

static void test_a_request_in_pieces_is_one(void)
{
    char text[300];

    int length =
        snprintf(text, sizeof text, "{\"number\":5,\"token\":\"%s\",\"act\":\"kill\",\"robot\":3}",
                 viewed.token);
    for (int i = 0; i < length; i++)
        client_send(&client, i == 0 ? CLIENT_TEXT : CLIENT_PART, i == length - 1, text + i, 1);
    struct act act = viewed_act(&viewed);
    TEST_ASSERT_EQUAL_INT(ACT_KILL, act.kind);
    TEST_ASSERT_EQUAL_UINT32(5, act.number);
    client_send(&client, CLIENT_TEXT, false, text, (size_t)length);
    client_close(&client);
    assert_no_act();
}

static void test_who_says_too_much_is_hung_up_on(void)
{
    static char text[20000];

    memset(text, ' ', sizeof text);
    snprintf(text, sizeof text, "{\"number\":5,\"token\":\"%s\",\"act\":\"estop\"}", viewed.token);
    text[strlen(text)] = ' ';
    client_send(&client, CLIENT_TEXT, true, text, sizeof text);
    expect_end(1009);
    assert_no_act();
}

static void test_so_is_who_never_ends(void)
{
    static char spaces[5000];

    memset(spaces, ' ', sizeof spaces);
    client_send(&client, CLIENT_TEXT, false, spaces, sizeof spaces);
    client_send(&client, CLIENT_PART, false, spaces, sizeof spaces);
    expect_end(1009);
    assert_no_act();
}

static void test_and_who_sends_bytes(void)
{
    client_send(&client, CLIENT_BINARY, true, "{\"number\":1}", 12);
    expect_end(1003);
    assert_no_act();
}

static void test_more_than_can_be_taken_is_refused(void)
{
    enum { WAITING = 64 };
    struct act act;

    for (unsigned i = 1; i <= WAITING + 1; i++)
        viewed_ask(&viewed, &client, i, "\"step\"");
    expect_refusal(WAITING + 1, "too many requests are waiting");
    for (unsigned i = 1; i <= WAITING; i++) {
        TEST_ASSERT_TRUE(view_next_act(viewed.view, &act));
        TEST_ASSERT_EQUAL_UINT32(i, act.number);
    }
    TEST_ASSERT_FALSE(view_next_act(viewed.view, &act));
    assert_no_act();
}

/* Whatever second it is where they arrive, some of so many are in the same one. */
static void test_who_asks_too_often_is_refused(void)
{
    enum { ROUNDS = 50, EACH = 100 };
    char text[500] = "";

    for (int round = 0; round < ROUNDS && strstr(text, "100 requests a second") == NULL; round++) {
        for (unsigned i = 0; i < EACH; i++)
            viewed_ask(&viewed, &client, i, "\"dance\"");
        for (unsigned i = 0; i < EACH; i++)
            viewed_text(&client, text, sizeof text);
    }
    TEST_ASSERT_NOT_NULL(strstr(text, "more than 100 requests a second"));
    assert_no_act();
}

static void test_who_asks_and_reads_no_answers_is_hung_up_on(void)
{
    for (int i = 0; i < 100000 && view_viewers(viewed.view) > 0; i++)
        client_send_text(&client, "{\"number\":1,\"act\":\"estop\"}");
    expect_end(1008);
    assert_no_act();
}

static void mutate(char *text, size_t *length, size_t room, uint32_t *state)
{
    size_t at = random_next(state) % *length;

    switch (random_next(state) % 4) {
    case 0: text[at] = (char)(random_next(state) % 255 + 1); break;
    case 1: text[at] ^= (char)(1 << random_next(state) % 7); break;
    case 2:
        memmove(text + at, text + at + 1, *length - at - 1);
        --*length;
        break;
    default:
        if (*length == room)
            break;
        memmove(text + at + 1, text + at, *length - at);
        ++*length;
        break;
    }
}

/* All tokens are wrong by three letters, so that no mutation puts them right. */
static void test_mutated_requests_do_nothing(void)
{
    static const char *const rests[] = {
        "\"kill\",\"robot\":3", "\"estop\"",
        "\"draw\",\"name\":\"mine\",\"L\":[0,2,2.5],\"psi\":[0,1,-1]",
        "\"move\",\"robot\":3,\"x\":1.5,\"y\":-2,\"theta\":0.25"};
    uint32_t state = 1;
    char text[400];

    for (unsigned i = 0; i < MUTATIONS; i++) {
        size_t length =
            (size_t)snprintf(text, sizeof text, "{\"number\":%u,\"token\":\"%s\",\"act\":%s}", i,
                             viewed.token, rests[i % 4]);
        char *token = strstr(text, viewed.token);

        for (unsigned k = i % 30; k < i % 30 + 3; k++)
            token[k] = token[k] == 'f' ? 'e' : 'f';
        for (unsigned changes = i % 5; changes > 0; changes--)
            mutate(text, &length, sizeof text, &state);
        client_send(&client, CLIENT_TEXT, true, text, length);
        if (i % 20 == 19) {
            client_close(&client);
            viewed_join(&viewed, &client);
        }
    }
    assert_no_act();
}

/* The frames themselves are broken. */
static void test_mutated_frames_disturb_nobody(void)
{
    uint32_t state = 2;

    for (unsigned i = 0; i < MUTATIONS / 10; i++) {
        char bytes[64];

        for (size_t k = 0; k < sizeof bytes; k++)
            bytes[k] = (char)random_next(&state);
        client_say(&client, bytes, sizeof bytes);
        client_close(&client);
        viewed_join(&viewed, &client);
    }
    assert_no_act();
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_request_is_its_act_and_its_answer_the_askers);
    RUN_TEST(test_acts_keep_their_order);
    RUN_TEST(test_without_the_token_nothing_happens);
    RUN_TEST(test_what_is_no_request_is_passed_over);
    RUN_TEST(test_a_request_in_pieces_is_one);
    RUN_TEST(test_who_says_too_much_is_hung_up_on);
    RUN_TEST(test_so_is_who_never_ends);
    RUN_TEST(test_and_who_sends_bytes);
    RUN_TEST(test_more_than_can_be_taken_is_refused);
    RUN_TEST(test_who_asks_too_often_is_refused);
    RUN_TEST(test_who_asks_and_reads_no_answers_is_hung_up_on);
    RUN_TEST(test_mutated_requests_do_nothing);
    RUN_TEST(test_mutated_frames_disturb_nobody);
    return UNITY_END();
}
