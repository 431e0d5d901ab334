/* What our decoder makes of a frame of each version, line by line: `frame MAJOR MINOR HEX`, `models
 * HEX`, then `body ID NAME TRACKED AT TURN` for each, for natnet_poses.py to compare. */
#include "capture.h"
#include "natnet_writer.h"

#include <stdio.h>
#include <stdlib.h>

static const uint8_t versions[][2] = {
    {2, 5},  {2, 6}, {2, 7}, {2, 8}, {2, 9}, {2, 10},
    {2, 11}, {3, 0}, {3, 1}, {4, 0}, {4, 1}, {4, 2},
};

static const struct written_body bodies[] = {
    {3, "mu-03", {1.25f, 0.5f, -2.125f}, {0, 0.6f, 0, 0.8f}, true},
    {7, "mu-07", {-1, 0.25f, 0.75f}, {0.5f, -0.5f, 0.5f, 0.5f}, true},
    {11, "a lost one", {0.1f, 0.2f, 0.3f}, {0, 0, 0, 1}, false},
};

#define BODIES (sizeof bodies / sizeof *bodies)

static struct natnet_writer writer;
static struct capture_frame frame;

static enum capture_news take(void *session)
{
    char words[CAPTURE_WORDS_MAX];
    size_t used;

    return natnet_protocol.take(session, writer.bytes, writer.count, &used, &frame, words);
}

static void print_bytes(void)
{
    for (size_t i = 0; i < writer.count; i++)
        printf("%02x", writer.bytes[i]);
    printf("\n");
}

static void print_body(const struct capture_body *body)
{
    printf("body\t%d\t%s\t%d", body->id, body->name, body->tracked);
    for (size_t i = 0; i < 3; i++)
        printf("\t%.9g", body->at[i]);
    for (size_t i = 0; i < 4; i++)
        printf("\t%.9g", body->turn[i]);
    printf("\n");
}

static bool print_version(void *session, const uint8_t version[2])
{
    struct written_frame written = {
        .number = 4711, .time = 12.5, .crowded = true, .count = BODIES, .body = bodies};
    struct capture_options options = {.version = {version[0], version[1]}};

    natnet_protocol.begin(session, &options);
    writer.major = version[0];
    writer.minor = version[1];
    natnet_write_models(&writer, bodies, BODIES, true);
    if (take(session) != CAPTURE_NOTHING)
        return false;
    printf("models\t%u\t%u\t", version[0], version[1]);
    print_bytes();
    natnet_write_frame(&writer, &written);
    if (take(session) != CAPTURE_FRAME)
        return false;
    printf("frame\t%u\t%u\t", version[0], version[1]);
    print_bytes();
    for (size_t i = 0; i < frame.count; i++)
        print_body(&frame.body[i]);
    return true;
}

int main(void)
{
    void *session = malloc(natnet_protocol.session_bytes);
    bool good = session != NULL;

    for (size_t i = 0; good && i < sizeof versions / sizeof *versions; i++)
        good = print_version(session, versions[i]);
    free(session);
    return good ? 0 : 1;
}
