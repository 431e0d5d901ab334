/* A captured session of NatNet 3.0, sent to a source datagram by datagram: what the source tells
 * has to be what another decoder has read, every pose of it, in order. */
#include "capture_file.h"
#include "source.h"

#include <arpa/inet.h>
#include <assert.h>
#include <libfyaml.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <unistd.h>

#define SKIPPED 77
#define FRAMES 518
#define NEAR 1e-6
#define PATIENCE_US 10000000

/* The motion-capture system: a socket, and whom it sends to. */
struct system {
    struct watch watch;
    struct sockaddr_in asker;
    const char *folder;
    bool named; /* the names were asked for, and sent */
};

struct session {
    struct loop loop;
    struct watch tick;
    struct system system;
    struct source *source;
    struct fy_node *expected; /* the list of frames */
    int64_t deadline_us;
    int told, wrong;
};

static struct fy_node *member(struct fy_node *mapping, const char *key)
{
    struct fy_node *value = fy_node_mapping_lookup_by_string(mapping, key, FY_NT);

    if (value == NULL) {
        printf("the expected poses have no %s\n", key);
        exit(1);
    }
    return value;
}

static double number(struct fy_node *node)
{
    return strtod(fy_node_get_scalar0(node), NULL);
}

static bool near_all(const double *values, struct fy_node *expected, int count)
{
    for (int i = 0; i < count; i++)
        if (!(fabs(values[i] - number(fy_node_sequence_get_by_index(expected, i))) <= NEAR))
            return false;
    return fy_node_sequence_item_count(expected) == count;
}

static bool same_body(const struct capture_body *body, struct fy_node *expected)
{
    bool tracked = strcmp(fy_node_get_scalar0(member(expected, "valid")), "true") == 0;

    return body->id == (int)number(member(expected, "id")) && strcmp(body->name, "RaceQuad") == 0 &&
           body->tracked == tracked && near_all(body->at, member(expected, "pos"), 3) &&
           near_all(body->turn, member(expected, "quat"), 4);
}

static bool same_frame(const struct capture_frame *frame, struct fy_node *expected)
{
    struct fy_node *bodies = member(expected, "bodies");
    double latency =
        (number(member(expected, "transmit")) - number(member(expected, "mid_exposure"))) / 3312787;

    if (frame->number != (uint32_t)number(member(expected, "frame")) ||
        frame->count != (size_t)fy_node_sequence_item_count(bodies) ||
        fabs(frame->latency - latency) > NEAR)
        return false;
    for (size_t i = 0; i < frame->count; i++)
        if (!same_body(&frame->body[i], fy_node_sequence_get_by_index(bodies, (int)i)))
            return false;
    return true;
}

static void take_frame(void *context, const struct capture_frame *frame, int64_t arrival_us)
{
    struct session *session = context;
    struct fy_node *expected = fy_node_sequence_get_by_index(session->expected, session->told++);

    (void)arrival_us;
    if (expected == NULL || !same_frame(frame, expected)) {
        printf("frame %u, the %dth, is told otherwise than expected\n", frame->number,
               session->told);
        session->wrong++;
    }
}

static void say(void *context, bool problem, const char *words)
{
    (void)context;
    printf("%s%s\n", problem ? "problem: " : "", words);
}

static size_t read_packet(const char *folder, const char *name, uint8_t *bytes, size_t room)
{
    char path[4096];

    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *in = fopen(path, "rb");
    if (in == NULL) {
        printf("%s cannot be read\n", path);
        exit(1);
    }
    size_t count = fread(bytes, 1, room, in);
    fclose(in);
    return count;
}

static void answer(struct system *system, const char *name)
{
    uint8_t bytes[2048];
    size_t count = read_packet(system->folder, name, bytes, sizeof bytes);

    sendto(system->watch.fd, bytes, count, 0, (struct sockaddr *)&system->asker,
           sizeof system->asker);
}

/* As Motive did when it was asked. */
static void be_asked(struct watch *watch, uint32_t events)
{
    struct system *system = (struct system *)watch;
    socklen_t length = sizeof system->asker;
    uint8_t bytes[1024];
    ssize_t count =
        recvfrom(watch->fd, bytes, sizeof bytes, 0, (struct sockaddr *)&system->asker, &length);

    (void)events;
    if (count >= 4 && bytes[0] == 0)
        answer(system, "serverinfo_packet_v3.bin");
    if (count >= 4 && bytes[0] == 4) {
        answer(system, "modeldef_packet_v3.bin");
        system->named = true;
    }
}

static void tick(struct watch *watch, uint32_t events)
{
    struct session *session = (struct session *)((char *)watch - offsetof(struct session, tick));

    (void)events;
    loop_periods(watch->fd);
    source_tick(session->source, loop_now());
    if (loop_now() > session->deadline_us) {
        printf("still waiting after %d frames\n", session->told);
        exit(1);
    }
}

static uint16_t open_system(struct session *session, const char *folder)
{
    struct sockaddr_in address = {.sin_family = AF_INET, .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
    socklen_t length = sizeof address;
    struct watch *watch = &session->system.watch;

    session->system.folder = folder;
    *watch = (struct watch){.fd = socket(AF_INET, SOCK_DGRAM, 0), .ready = be_asked};
    if (watch->fd < 0 || bind(watch->fd, (struct sockaddr *)&address, length) != 0 ||
        getsockname(watch->fd, (struct sockaddr *)&address, &length) != 0 ||
        !loop_watch(&session->loop, watch, EPOLLIN)) {
        perror("the system's socket");
        exit(1);
    }
    return ntohs(address.sin_port);
}

static void open_loop(struct session *session)
{
    session->deadline_us = loop_now() + PATIENCE_US;
    if (!loop_open(&session->loop)) {
        perror("loop");
        exit(1);
    }
    session->tick = (struct watch){.fd = loop_timer(20000), .ready = tick};
    if (!loop_watch(&session->loop, &session->tick, EPOLLIN)) {
        perror("timer");
        exit(1);
    }
}

/* One after the other, for a source that is late tells only the newest. */
static void replay(struct session *session, const char *folder)
{
    char path[4096];
    struct capture_file file;
    const uint8_t *payload;
    size_t count;
    int frames = 0;

    snprintf(path, sizeof path, "%s/traffic.pcapng", folder);
    if (!capture_file_open(&file, path)) {
        printf("%s cannot be read\n", path);
        exit(1);
    }
    while ((payload = capture_file_next(&file, &count)) != NULL) {
        frames += payload[0] == 7;
        sendto(session->system.watch.fd, payload, count, 0,
               (struct sockaddr *)&session->system.asker, sizeof session->system.asker);
        while (session->told < frames)
            loop_wait(&session->loop);
    }
    capture_file_close(&file);
}

static bool body_is(const struct capture_frame *frame, int32_t id, double x, double y, double z)
{
    const struct capture_body *body = &frame->body[0];

    return frame->count == 1 && body->id == id && body->tracked && fabs(body->at[0] - x) < NEAR &&
           fabs(body->at[1] - y) < NEAR && fabs(body->at[2] - z) < NEAR;
}

/* Single packets, with a skeleton's and unlabelled markers about the body, and markers occluded. */
static bool check_packet(const char *folder, const char *name, int32_t id, double x, double y,
                         double z)
{
    static struct capture_frame frame;
    void *natnet = malloc(natnet_protocol.session_bytes);
    uint8_t bytes[2048];
    char words[CAPTURE_WORDS_MAX];
    size_t used, count = read_packet(folder, name, bytes, sizeof bytes);

    assert(natnet != NULL);
    natnet_protocol.begin(natnet, &(struct capture_options){.version = {3, 0}});
    bool good = natnet_protocol.take(natnet, bytes, count, &used, &frame, words) == CAPTURE_FRAME &&
                body_is(&frame, id, x, y, z);
    printf("%s: %s\n", name, good ? "as expected" : "otherwise than expected");
    free(natnet);
    return good;
}

static bool check_packets(const char *folder)
{
    return check_packet(folder, "mocapframe_packet_v3.bin", 2, 0.174447, 1.447131, -0.734304) &&
           check_packet(folder, "mocapframe_packet_occluded_v3.bin", 7, -0.154131, 0.282945,
                        0.470664);
}

static struct fy_document *read_expected(struct session *session, const char *folder)
{
    char path[4096];
    struct fy_parse_cfg config = {.flags = FYPCF_QUIET | FYPCF_JSON_FORCE};

    snprintf(path, sizeof path, "%s/expected-3.0.json", folder);
    struct fy_document *document = fy_document_build_from_file(&config, path);
    if (document == NULL) {
        printf("%s cannot be read\n", path);
        exit(1);
    }
    session->expected = member(member(fy_document_root(document), "3.0"), "frames");
    return document;
}

int main(void)
{
    const char *folder = getenv("MUSTER_MOCAP_CAPTURES");
    static struct session session;
    struct source_owner owner = {&session, take_frame, say};
    struct source_settings settings = {
        .protocol = &natnet_protocol, .server = "127.0.0.1", .options.unicast = true};
    char error[256] = "";

    if (folder == NULL) {
        printf("skipped: MUSTER_MOCAP_CAPTURES does not name the folder of the captures\n");
        return SKIPPED;
    }
    struct fy_document *document = read_expected(&session, folder);
    open_loop(&session);
    settings.port = open_system(&session, folder);
    session.source = source_open(&session.loop, &settings, &owner, error, sizeof error);
    if (session.source == NULL) {
        printf("%s\n", error);
        return 1;
    }
    while (!session.system.named)
        loop_wait(&session.loop);
    replay(&session, folder);
    printf("%d of %d frames told, %d otherwise than expected; %s\n", session.told, FRAMES,
           session.wrong, source_words(session.source));
    source_close(session.source);
    fy_document_destroy(document);
    loop_forget(&session.loop, &session.system.watch);
    close(session.system.watch.fd);
    close(session.tick.fd);
    loop_close(&session.loop);
    bool good = check_packets(folder) && session.told == FRAMES && session.wrong == 0;
    return good ? 0 : 1;
}
