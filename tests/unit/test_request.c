#include "request.h"

#include <stdio.h>
#include <string.h>
#include <unity.h>

#define TOKEN "0123456789abcdef0123456789abcdef"
#define ALL 0xFFFFu

static struct request_rules rules;
static struct act act;
static char words[REQUEST_WORDS_MAX];

void setUp(void)
{
    rules = (struct request_rules){TOKEN, "sim", ALL};
}

void tearDown(void)
{
}

static enum request_end read_text(const char *text)
{
    words[0] = '\0';
    return request_read(&rules, text, strlen(text), &act, words);
}

/* A request with the token and number 7; `rest` begins with the act's word. */
static enum request_end read_rest(const char *rest)
{
    char text[REQUEST_BYTES_MAX];

    snprintf(text, sizeof text, "{\"number\":7,\"token\":\"" TOKEN "\",\"act\":%s}", rest);
    return read_text(text);
}

static void assert_refused(const char *rest, const char *expected)
{
    TEST_ASSERT_EQUAL_INT_MESSAGE(REQUEST_REFUSED, read_rest(rest), rest);
    TEST_ASSERT_EQUAL_UINT32(7, act.number);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(words, expected), words);
}

static void test_every_act_is_read(void)
{
    static const char *const rests[ACT_COUNT] = {
        [ACT_KILL] = "\"kill\",\"robot\":3",
        [ACT_REVIVE] = "\"revive\",\"robot\":3",
        [ACT_STALL] = "\"stall\",\"robot\":3",
        [ACT_MUTE] = "\"mute\",\"robot\":3",
        [ACT_UNMUTE] = "\"unmute\",\"robot\":3",
        [ACT_DRAIN] = "\"drain\",\"robot\":3",
        [ACT_MOVE] = "\"move\",\"robot\":3,\"x\":1.5,\"y\":-2,\"theta\":0.25",
        [ACT_FORMATION] = "\"formation\",\"name\":\"v-7\"",
        [ACT_DRAW] = "\"draw\",\"name\":\"mine\",\"L\":[0,2,2.5],\"psi\":[0,1,-1]",
        [ACT_ESTOP] = "\"estop\"",
        [ACT_BEGIN] = "\"begin\"",
        [ACT_END] = "\"end\"",
        [ACT_PAUSE] = "\"pause\"",
        [ACT_RESUME] = "\"resume\"",
        [ACT_STEP] = "\"step\"",
        [ACT_SPEED] = "\"speed\",\"speed\":2.5",
    };

    for (int kind = 0; kind < ACT_COUNT; kind++) {
        TEST_ASSERT_EQUAL_INT_MESSAGE(REQUEST_GOOD, read_rest(rests[kind]), rests[kind]);
        TEST_ASSERT_EQUAL_INT(kind, act.kind);
        TEST_ASSERT_EQUAL_UINT32(7, act.number);
        TEST_ASSERT_EQUAL_UINT(kind <= ACT_MOVE ? 3 : 0, act.robot);
    }
}

static void test_values_arrive(void)
{
    read_rest("\"move\",\"robot\":65534,\"x\":-2097,\"y\":2e3,\"theta\":-100");
    TEST_ASSERT_EQUAL_UINT(65534, act.robot);
    TEST_ASSERT_EQUAL_DOUBLE(-2097, act.pose.x);
    TEST_ASSERT_EQUAL_DOUBLE(2000, act.pose.y);
    TEST_ASSERT_EQUAL_DOUBLE(-100, act.pose.theta);
    read_rest("\"draw\",\"name\":\"A.b_9-\",\"L\":[1.25,0],\"psi\":[3,0.5]");
    TEST_ASSERT_EQUAL_STRING("A.b_9-", act.name);
    TEST_ASSERT_EQUAL_UINT(2, act.count);
    TEST_ASSERT_EQUAL_DOUBLE(1.25, act.L[0]);
    TEST_ASSERT_EQUAL_DOUBLE(0.5, act.psi[1]);
    read_rest("\"speed\",\"speed\":0");
    TEST_ASSERT_EQUAL_DOUBLE(0, act.speed);
}

static void test_without_the_token_nothing_is_done(void)
{
    static const char *const tokens[] = {
        "",
        "\"token\":null,",
        "\"token\":12,",
        "\"token\":[\"" TOKEN "\"],",
        "\"token\":\"\",",
        "\"token\":\"0123456789abcdef0123456789abcde\",",
        "\"token\":\"0123456789abcdef0123456789abcdeg\",",
        "\"token\":\"1123456789abcdef0123456789abcdef\",",
        "\"token\":\"0123456789ABCDEF0123456789ABCDEF\",",
        "\"token\":\"" TOKEN "0\",",
        "\"Token\":\"" TOKEN "\",",
    };
    char text[300];

    for (size_t i = 0; i < sizeof tokens / sizeof tokens[0]; i++) {
        snprintf(text, sizeof text, "{\"number\":7,%s\"act\":\"estop\"}", tokens[i]);
        TEST_ASSERT_EQUAL_INT_MESSAGE(REQUEST_REFUSED, read_text(text), text);
        TEST_ASSERT_NOT_NULL(strstr(words, "token"));
    }
}

static void test_who_has_no_number_gets_no_answer(void)
{
    static const char *const texts[] = {
        "",
        "null",
        "7",
        "[]",
        "{}",
        "{",
        "{\"token\":\"" TOKEN "\",\"act\":\"estop\"}",
        "{\"number\":-1,\"token\":\"" TOKEN "\",\"act\":\"estop\"}",
        "{\"number\":4294967296,\"token\":\"" TOKEN "\",\"act\":\"estop\"}",
        "{\"number\":1.0,\"token\":\"" TOKEN "\",\"act\":\"estop\"}",
        "{\"number\":\"1\",\"token\":\"" TOKEN "\",\"act\":\"estop\"}",
        "{\"number\":7,\"token\":\"" TOKEN "\",\"act\":\"estop\"} 1",
        "{\"number\":7,\"token\":\"" TOKEN "\",\"act\":\"estop\",\"act\":\"kill\"}",
        "{\"number\":7,\"token\":\"" TOKEN "\\u0000\",\"act\":\"estop\"}",
    };

    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++)
        TEST_ASSERT_EQUAL_INT_MESSAGE(REQUEST_UNANSWERABLE, read_text(texts[i]), texts[i]);
}

static void test_what_is_not_exactly_a_request_is_refused(void)
{
    assert_refused("\"dance\"", "no such act");
    assert_refused("7", "no such act");
    assert_refused("\"kill\"", "kill needs \"robot\"");
    assert_refused("\"kill\",\"robot\":0", "kill needs \"robot\"");
    assert_refused("\"kill\",\"robot\":65535", "kill needs \"robot\"");
    assert_refused("\"kill\",\"robot\":65539", "kill needs \"robot\"");
    assert_refused("\"kill\",\"robot\":3.0", "kill needs \"robot\"");
    assert_refused("\"kill\",\"robot\":\"3\"", "kill needs \"robot\"");
    assert_refused("\"kill\",\"robot\":3,\"x\":1", "a key too many");
    assert_refused("\"estop\",\"robot\":3", "a key too many");
    assert_refused("\"move\",\"robot\":3,\"x\":1,\"y\":1", "move needs \"theta\"");
    assert_refused("\"move\",\"robot\":3,\"x\":2097.1,\"y\":1,\"theta\":0", "move needs \"x\"");
    assert_refused("\"move\",\"robot\":3,\"x\":1,\"y\":-3000,\"theta\":0", "move needs \"y\"");
    assert_refused("\"move\",\"robot\":3,\"x\":1,\"y\":true,\"theta\":0", "move needs \"y\"");
    assert_refused("\"speed\",\"speed\":0.001", "speed needs \"speed\"");
    assert_refused("\"speed\",\"speed\":1001", "speed needs \"speed\"");
    assert_refused("\"speed\",\"speed\":-1", "speed needs \"speed\"");
    assert_refused("\"formation\",\"name\":\"\"", "formation needs \"name\"");
    assert_refused("\"formation\",\"name\":\"a b\"", "formation needs \"name\"");
    assert_refused("\"formation\",\"name\":\"../x\"", "formation needs \"name\"");
    assert_refused("\"formation\",\"name\":\"0123456789012345678901234567890123456789"
                   "012345678901234567890123\"",
                   "formation needs \"name\"");
}

static void test_a_drawing_has_one_leader_and_two_lists_of_one_length(void)
{
    assert_refused("\"draw\",\"name\":\"a\",\"L\":[1,2],\"psi\":[0,0]", "draw needs \"L\"");
    assert_refused("\"draw\",\"name\":\"a\",\"L\":[0,0],\"psi\":[0,0]", "draw needs \"L\"");
    assert_refused("\"draw\",\"name\":\"a\",\"L\":[],\"psi\":[]", "draw needs \"L\"");
    assert_refused("\"draw\",\"name\":\"a\",\"L\":0,\"psi\":0", "draw needs \"L\"");
    assert_refused("\"draw\",\"name\":\"a\",\"L\":[0,\"1\"],\"psi\":[0,0]", "draw needs \"L\"");
    assert_refused("\"draw\",\"name\":\"a\",\"L\":[0,1],\"psi\":[0]", "draw needs \"psi\"");
    assert_refused("\"draw\",\"name\":\"a\",\"L\":[0],\"psi\":[0,1]", "draw needs \"psi\"");
    assert_refused("\"draw\",\"name\":\"a\",\"L\":[0],\"psi\":[null]", "draw needs \"psi\"");
}

static void test_as_many_vertices_as_there_may_be_and_no_more(void)
{
    char rest[REQUEST_BYTES_MAX] = "\"draw\",\"name\":\"a\",\"L\":[0", psi[1000] = "0";

    for (int i = 1; i < ACT_VERTICES_MAX; i++) {
        strcat(rest, ",12.3456789012345");
        strcat(psi, ",0");
    }
    size_t length = strlen(rest);
    sprintf(rest + length, "],\"psi\":[%s]", psi);
    TEST_ASSERT_EQUAL_INT(REQUEST_GOOD, read_rest(rest));
    TEST_ASSERT_EQUAL_UINT(ACT_VERTICES_MAX, act.count);
    sprintf(rest + length, ",1],\"psi\":[%s,0]", psi);
    assert_refused(rest, "draw needs \"L\"");
}

static void test_what_this_run_cannot_do_is_refused_in_words(void)
{
    rules.acts = ACT_BIT(ACT_ESTOP);
    rules.kind = "serve";
    assert_refused("\"move\",\"robot\":3,\"x\":1,\"y\":1,\"theta\":0",
                   "move is nothing that a run of real robots can do");
    TEST_ASSERT_EQUAL_INT(REQUEST_GOOD, read_rest("\"estop\""));
    rules.acts = 0;
    rules.kind = "replay";
    assert_refused("\"estop\"", "a replay cannot be acted on");
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_every_act_is_read);
    RUN_TEST(test_values_arrive);
    RUN_TEST(test_without_the_token_nothing_is_done);
    RUN_TEST(test_who_has_no_number_gets_no_answer);
    RUN_TEST(test_what_is_not_exactly_a_request_is_refused);
    RUN_TEST(test_a_drawing_has_one_leader_and_two_lists_of_one_length);
    RUN_TEST(test_as_many_vertices_as_there_may_be_and_no_more);
    RUN_TEST(test_what_this_run_cannot_do_is_refused_in_words);
    return UNITY_END();
}
