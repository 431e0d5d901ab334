#define _GNU_SOURCE /* nftw() */
#include "onlooker.h"

#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/epoll.h>
#include <unistd.h>
#include <unity.h>

#define PATIENCE_US 60000000
#define CLOCK_US 20000
#define ARGUMENTS_MAX 12

/* docs/VIEWING.md: a record, with the CDR message behind its head. */
#define RECORD_HEAD 12
#define RECORD_SCENE 1

static void on_clock(struct watch *watch, uint32_t events)
{
    (void)events;
    loop_periods(watch->fd);
}

void onlooker_open(struct onlooker *onlooker)
{
    *onlooker = (struct onlooker){.process = {.input = -1}, .client = {.fd = -1}};
    onlooker->seen_ms = -TICK_MS;
    snprintf(onlooker->dir, sizeof onlooker->dir, "/tmp/muster-onlooker-XXXXXX");
    TEST_ASSERT_NOT_NULL(mkdtemp(onlooker->dir));
    TEST_ASSERT_TRUE(loop_open(&onlooker->loop));
    onlooker->clock = (struct watch){.fd = loop_timer(CLOCK_US), .ready = on_clock};
    TEST_ASSERT_TRUE(loop_watch(&onlooker->loop, &onlooker->clock, EPOLLIN));
}

static int remove_one(const char *path, const struct stat *status, int kind, struct FTW *place)
{
    (void)status;
    (void)kind;
    (void)place;
    return remove(path);
}

void onlooker_close(struct onlooker *onlooker)
{
    if (Unity.CurrentTestFailed && onlooker->process.said != NULL)
        printf("%s said:\n%s\n", onlooker->process.name, onlooker->process.said);
    process_close(&onlooker->process);
    client_close(&onlooker->client);
    for (size_t i = 0; i < TICKS; i++)
        free(onlooker->seen[i].bytes);
    loop_close(&onlooker->loop);
    close(onlooker->clock.fd);
    nftw(onlooker->dir, remove_one, 8, FTW_DEPTH | FTW_PHYS);
}

/* ---- the process ----------------------------------------------------------------------- */

static void start(struct onlooker *onlooker, const char *const arguments[])
{
    const char *argv[ARGUMENTS_MAX + 2] = {STAGE_MUSTER};

    for (size_t i = 0; arguments[i] != NULL; i++) {
        TEST_ASSERT_TRUE(i < ARGUMENTS_MAX);
        argv[i + 1] = arguments[i];
    }
    process_start(&onlooker->process, &onlooker->loop, argv, NULL);
}

static void wait_on(struct onlooker *onlooker, int64_t deadline_us, const char *words)
{
    TEST_ASSERT_TRUE_MESSAGE(loop_now() < deadline_us, words);
    TEST_ASSERT_TRUE(loop_wait(&onlooker->loop));
}

static bool has_a_view(const struct process *process)
{
    const char *url = process_said(process, "view: http://");

    return url != NULL && strchr(url, '\n') != NULL;
}

void onlooker_start(struct onlooker *onlooker, const char *const arguments[])
{
    int64_t deadline_us = loop_now() + PATIENCE_US;

    start(onlooker, arguments);
    while (!has_a_view(&onlooker->process))
        wait_on(onlooker, deadline_us, "no view");
}

int onlooker_end(struct onlooker *onlooker)
{
    int64_t deadline_us = loop_now() + PATIENCE_US;

    while (!process_ended(&onlooker->process))
        wait_on(onlooker, deadline_us, "it does not end");
    return onlooker->process.status;
}

int onlooker_run(struct onlooker *onlooker, const char *const arguments[])
{
    start(onlooker, arguments);
    return onlooker_end(onlooker);
}

/* ---- looking on ------------------------------------------------------------------------ */

void onlooker_join(struct onlooker *onlooker, const char *protocol)
{
    const char *url = process_said(&onlooker->process, "http://");
    unsigned port;
    char host[32];

    client_connect(&onlooker->client, url);
    TEST_ASSERT_EQUAL_INT(1, sscanf(url, "http://127.0.0.1:%u/", &port));
    snprintf(host, sizeof host, "127.0.0.1:%u", port);
    TEST_ASSERT_EQUAL_INT(101, client_upgrade(&onlooker->client, host, protocol, NULL));
}

/* The time, as s and ns, comes first behind CDR's head. */
static void see_scene(struct onlooker *onlooker, const uint8_t *fleet, size_t count)
{
    int32_t sec;
    uint32_t ns;

    memcpy(&sec, fleet + 4, sizeof sec);
    memcpy(&ns, fleet + 8, sizeof ns);
    int32_t ms = sec * 1000 + (int32_t)(ns / 1000000);
    if (ms < 0)
        return;
    TEST_ASSERT_TRUE(ms < TICKS * TICK_MS);
    struct seen *scene = &onlooker->seen[ms / TICK_MS];
    onlooker->scenes += scene->bytes == NULL;
    free(scene->bytes);
    scene->bytes = malloc(count);
    TEST_ASSERT_NOT_NULL(scene->bytes);
    memcpy(scene->bytes, fleet, count);
    scene->count = count;
    onlooker->seen_ms = ms > onlooker->seen_ms ? ms : onlooker->seen_ms;
}

static void see(struct onlooker *onlooker, const struct client_message *message)
{
    size_t at = 0;

    while (at < message->count) {
        uint32_t count;

        memcpy(&count, message->bytes + at + 8, sizeof count);
        if (message->bytes[at] == RECORD_SCENE)
            see_scene(onlooker, message->bytes + at + RECORD_HEAD, count);
        else
            onlooker->events++;
        at += (RECORD_HEAD + count + 7) / 8 * 8;
    }
}

struct client_message onlooker_look(struct onlooker *onlooker)
{
    struct client_message message = client_receive(&onlooker->client);

    if (message.opcode == CLIENT_BINARY)
        see(onlooker, &message);
    return message;
}
