#define _GNU_SOURCE /* nftw() */
#include "hand.h"

#include <ftw.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/epoll.h>
#include <unistd.h>
#include <unity.h>

/* Nothing that is waited for takes as long, on whatever machine. */
#define PATIENCE_US 60000000

#define CLOCK_US 20000
#define ARGUMENTS_MAX 16

static void on_clock(struct watch *watch, uint32_t events)
{
    (void)events;
    loop_periods(watch->fd);
}

void hand_open(struct hand *hand)
{
    *hand = (struct hand){.open = true, .clock = {.ready = on_clock}};
    signal(SIGPIPE, SIG_IGN); /* what a command's end that came too early is told by */
    TEST_ASSERT_TRUE(loop_open(&hand->loop));
    hand->clock.fd = loop_timer(CLOCK_US);
    TEST_ASSERT_TRUE(loop_watch(&hand->loop, &hand->clock, EPOLLIN));
    snprintf(hand->directory, sizeof hand->directory, "/tmp/muster-hand-XXXXXX");
    TEST_ASSERT_NOT_NULL(mkdtemp(hand->directory));
}

static void start(struct hand *hand, struct process *process, const char *command,
                  const char *const arguments[])
{
    const char *argv[ARGUMENTS_MAX + 3] = {STAGE_MUSTER, command};
    size_t count = 2;

    for (size_t i = 0; arguments[i] != NULL; i++) {
        TEST_ASSERT_TRUE(i < ARGUMENTS_MAX);
        argv[count++] = arguments[i];
    }
    argv[count] = NULL;
    process_start(process, &hand->loop, argv, NULL);
}

static void wait_on(struct hand *hand, int64_t deadline_us, const char *words)
{
    TEST_ASSERT_TRUE_MESSAGE(loop_now() < deadline_us, words);
    TEST_ASSERT_TRUE(loop_wait(&hand->loop));
}

/* ---- robots ---------------------------------------------------------------------------- */

static size_t lines_of(const struct process *process)
{
    size_t lines = 0;

    for (const char *at = process->said; at != NULL && (at = strchr(at, '\n')) != NULL; at++)
        lines++;
    return lines;
}

static void take_link(struct hand *hand, const char *line)
{
    const char *link = strstr(line, ": ");

    TEST_ASSERT_NOT_NULL_MESSAGE(link, line);
    TEST_ASSERT_TRUE(hand->robot_count < HAND_ROBOTS);
    snprintf(hand->link[hand->robot_count++], sizeof hand->link[0], "%.*s",
             (int)strcspn(link + 2, "\n"), link + 2);
}

/* Links are told in one go. */
void hand_add(struct hand *hand, const char *const options[])
{
    struct process *crew = &hand->crew[hand->crew_count++];
    int64_t deadline_us = loop_now() + PATIENCE_US;

    TEST_ASSERT_TRUE(hand->crew_count <= HAND_CREWS);
    start(hand, crew, "robot", options);
    while (lines_of(crew) == 0)
        wait_on(hand, deadline_us, "no robots");
    for (const char *at = crew->said; *at != '\0'; at = strchr(at, '\n') + 1)
        take_link(hand, at);
}

/* ---- the arena ------------------------------------------------------------------------- */

static unsigned wait_for_port(struct hand *hand, const char *before)
{
    int64_t deadline_us = loop_now() + PATIENCE_US;
    const char *at;
    unsigned port;

    while ((at = process_said(&hand->arena, before)) == NULL)
        wait_on(hand, deadline_us, "no arena");
    TEST_ASSERT_EQUAL_INT(1, sscanf(at + strlen(before), "%u", &port));
    return port;
}

void hand_add_arena(struct hand *hand, const char *scenario)
{
    char path[128];

    snprintf(path, sizeof path, "%s/arena.yaml", hand->directory);
    FILE *file = fopen(path, "w");
    TEST_ASSERT_NOT_NULL_MESSAGE(file, path);
    fputs(scenario, file);
    TEST_ASSERT_EQUAL_INT(0, fclose(file));
    start(hand, &hand->arena, "arena",
          (const char *const[]){"--unicast", "--port", "0", "--data-port", "0", "--robots-port",
                                "0", path, NULL});
    hand->natnet_port = wait_for_port(hand, "arena: natnet 127.0.0.1:");
    hand->robots_port = wait_for_port(hand, "robots 127.0.0.1:");
}

const char *hand_site(struct hand *hand, const unsigned ids[])
{
    static char path[128];

    snprintf(path, sizeof path, "%s/site.yaml", hand->directory);
    FILE *file = fopen(path, "w");
    TEST_ASSERT_NOT_NULL_MESSAGE(file, path);
    fputs("schema: 1\nname: hand\nmocap: {protocol: natnet, server: 127.0.0.1}\nrobots:\n", file);
    for (size_t i = 0; ids[i] != 0; i++) {
        if (i < hand->robot_count)
            fprintf(file, "  - {id: %u, link: \"%s\"}\n", ids[i], hand->link[i]);
        else
            fprintf(file, "  - {id: %u, link: \"tty:%s/absent-%zu\"}\n", ids[i], hand->directory,
                    i);
    }
    TEST_ASSERT_EQUAL_INT(0, fclose(file));
    return path;
}

void hand_waits(struct hand *hand, const char *words)
{
    int64_t deadline_us = loop_now() + PATIENCE_US;

    while (process_said(&hand->command, words) == NULL)
        wait_on(hand, deadline_us, words);
}

void hand_hears(struct hand *hand, size_t crew, const char *words)
{
    int64_t deadline_us = loop_now() + PATIENCE_US;

    while (process_said(&hand->crew[crew], words) == NULL)
        wait_on(hand, deadline_us, words);
}

void hand_power_cycle(struct hand *hand, size_t crew)
{
    process_signal(&hand->crew[crew], SIGUSR1);
}

/* ---- commands -------------------------------------------------------------------------- */

void hand_start(struct hand *hand, const char *const arguments[])
{
    if (hand->command.loop != NULL)
        process_close(&hand->command);
    start(hand, &hand->command, arguments[0], arguments + 1);
}

/* Its end is no event; what it has said is read to the end. */
int hand_end(struct hand *hand)
{
    int64_t deadline_us = loop_now() + PATIENCE_US;

    while (!process_ended(&hand->command) || hand->command.output.watched)
        wait_on(hand, deadline_us, "the command does not end");
    return hand->command.status;
}

int hand_run(struct hand *hand, const char *const arguments[])
{
    hand_start(hand, arguments);
    return hand_end(hand);
}

bool hand_said(const struct hand *hand, const char *words)
{
    return process_said(&hand->command, words) != NULL;
}

/* ---- end ------------------------------------------------------------------------------- */

static int remove_one(const char *path, const struct stat *about, int kind, struct FTW *place)
{
    (void)about;
    (void)kind;
    (void)place;
    return remove(path);
}

static void end(struct process *process)
{
    if (Unity.CurrentTestFailed && process->said != NULL)
        printf("---- %s\n%s", process->name, process->said);
    process_close(process);
}

void hand_close(struct hand *hand)
{
    if (!hand->open)
        return;
    end(&hand->command);
    end(&hand->arena);
    for (size_t i = 0; i < hand->crew_count; i++)
        end(&hand->crew[i]);
    close(hand->clock.fd);
    loop_close(&hand->loop);
    nftw(hand->directory, remove_one, 8, FTW_DEPTH | FTW_PHYS);
    hand->open = false;
}
