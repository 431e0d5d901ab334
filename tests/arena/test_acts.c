/* What those who look on do to real robots, through the server's view and by its protocol. */
#include "stage.h"

#include "viewed.h"

#include <stdio.h>
#include <string.h>
#include <unity.h>

static struct stage stage;
static struct viewed viewed;
static struct client client;
static char url[128];

void setUp(void)
{
    client = (struct client){.fd = -1};
}

void tearDown(void)
{
    client_close(&client);
    stage_close(&stage);
}

/* Of what the server says: where its page is. */
static void join(void)
{
    stage_says(&stage, "view: ");
    TEST_ASSERT_EQUAL_INT(1, sscanf(process_said(&stage.server, "view: "), "view: %127s", url));
    viewed = (struct viewed){.url = url, .token = strchr(url, '#') + 1};
    TEST_ASSERT_EQUAL_INT(1, sscanf(url, "http://%63[0-9.:]", viewed.host));
    viewed_join(&viewed, &client);
}

/* The answer to it, "null" or the words of its refusal, is `expected`. */
static void ask(const char *request, const char *expected)
{
    static unsigned number;
    char begin[64], text[1024];

    viewed_ask(&viewed, &client, ++number, request);
    snprintf(begin, sizeof begin, "{\"answer\":{\"number\":%u,", number);
    do
        viewed_text(&client, text, sizeof text);
    while (strncmp(text, "{\"answer\"", 9) != 0);
    TEST_ASSERT_EQUAL_INT_MESSAGE(0, strncmp(text, begin, strlen(begin)), text);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(text, expected), text);
}

static void open_stage(void)
{
    static const struct stage_plan plan = {
        .duration = 60,
        .cable = CABLE_NONE,
        .looked_at = true,
    };

    stage_open(&stage, &plan);
    join();
}

static void robots_are_halted_and_go_on(void)
{
    open_stage();
    stage_begin(&stage);
    ask("\"begin\"", "it has begun");
    ask("\"kill\",\"robot\":9", "robot 9 is not in this scenario: it has 1 to 4");
    ask("\"move\",\"robot\":3,\"x\":0,\"y\":0,\"theta\":0", "is nothing that");
    stage_drives(&stage, 3);
    stage_mark(&stage);
    ask("\"kill\",\"robot\":3", "null");
    stage_stands(&stage, 3);
    stage_drove_on(&stage, 4);
    ask("\"revive\",\"robot\":3", "null");
    stage_drives(&stage, 3);
    stage_mark(&stage);
    ask("\"stall\",\"robot\":4", "null");
    stage_stands(&stage, 4);
    ask("\"draw\",\"name\":\"pair\",\"L\":[0,0.4],\"psi\":[0,3.1]", "null");
    ask("\"formation\",\"name\":\"pair\"", "null");
    ask("\"end\"", "null");
    stage_server_ends(&stage, 0);
    TEST_ASSERT_TRUE(stage_logged(&stage, ",3,kill,"));
    TEST_ASSERT_TRUE(stage_logged(&stage, ",3,revive,"));
    TEST_ASSERT_TRUE(stage_logged(&stage, ",4,stall,"));
    TEST_ASSERT_TRUE(stage_logged(&stage, ",0,draw,pair"));
    TEST_ASSERT_TRUE(stage_logged(&stage, ",0,stop,ended by one who looks on"));
    stage_end(&stage);
}

static void the_emergency_stop_is_everybodys(void)
{
    open_stage();
    stage_begin(&stage);
    for (unsigned id = 1; id <= STAGE_ROBOTS; id++)
        stage_drives(&stage, id);
    stage_mark(&stage);
    ask("\"estop\"", "null");
    for (unsigned id = 1; id <= STAGE_ROBOTS; id++)
        stage_stands(&stage, id);
    ask("\"end\"", "null");
    stage_server_ends(&stage, 0);
    TEST_ASSERT_TRUE(stage_logged(&stage, ",0,estop,"));
    stage_end(&stage);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(robots_are_halted_and_go_on);
    RUN_TEST(the_emergency_stop_is_everybodys);
    return stage_verdict();
}
