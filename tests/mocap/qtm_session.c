/* qtm_session STREAM POSES: a session with QTM, made up: what QTM says, byte by byte, into one file
 * and what our decoder makes of it into the other. qtm_session.py has another decoder judge. */
#include "capture.h"
#include "packet.h"
#include "poses.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FRAMES 300
#define BODIES 5

enum { KIND_COMMAND = 1, KIND_XML = 2, KIND_DATA = 3 };

struct made_up {
    void *session;
    FILE *stream, *poses;
    struct packet packet;
    struct capture_frame frame;
    char words[CAPTURE_WORDS_MAX];
};

static double chance(void)
{
    return (double)rand() / RAND_MAX;
}

static void ask(struct made_up *qtm)
{
    uint8_t bytes[CAPTURE_ASK_MAX];

    qtm_protocol.ask(qtm->session, 0, bytes, sizeof bytes);
}

/* Gives the packet to both; true when a frame, or nothing but good news, came of it. */
static bool say(struct made_up *qtm)
{
    size_t done = 0, used;
    enum capture_news news;

    fwrite(qtm->packet.bytes, 1, qtm->packet.count, qtm->stream);
    do {
        news = qtm_protocol.take(qtm->session, qtm->packet.bytes + done, qtm->packet.count - done,
                                 &used, &qtm->frame, qtm->words);
        done += used;
        if (news == CAPTURE_FRAME)
            poses_write_frame(qtm->poses, llround(qtm->frame.time * 1e6), &qtm->frame);
    } while (used > 0 && news != CAPTURE_BROKEN && news != CAPTURE_REFUSED);
    ask(qtm);
    qtm->packet.count = 0;
    return used == 0;
}

static void put_header(struct packet *packet, uint32_t count, uint32_t kind)
{
    put_u32_le(packet, 8 + count);
    put_u32_le(packet, kind);
}

static bool say_text(struct made_up *qtm, uint32_t kind, const char *text)
{
    put_header(&qtm->packet, (uint32_t)strlen(text) + 1, kind);
    put_field(&qtm->packet, text, strlen(text) + 1);
    return say(qtm);
}

/* The columns of a turn about a random axis. */
static void put_columns(struct packet *packet)
{
    double q[4], length = 0;

    for (int i = 0; i < 4; i++) {
        q[i] = chance() - 0.5;
        length += q[i] * q[i];
    }
    for (int i = 0; i < 4; i++)
        q[i] /= sqrt(length);
    const double columns[9] = {
        1 - 2 * (q[1] * q[1] + q[2] * q[2]), 2 * (q[0] * q[1] + q[2] * q[3]),
        2 * (q[0] * q[2] - q[1] * q[3]),     2 * (q[0] * q[1] - q[2] * q[3]),
        1 - 2 * (q[0] * q[0] + q[2] * q[2]), 2 * (q[1] * q[2] + q[0] * q[3]),
        2 * (q[0] * q[2] + q[1] * q[3]),     2 * (q[1] * q[2] - q[0] * q[3]),
        1 - 2 * (q[0] * q[0] + q[1] * q[1]),
    };
    for (int i = 0; i < 9; i++)
        put_f32_le(packet, (float)columns[i]);
}

static void put_body(struct packet *packet)
{
    if (chance() < 0.1) {
        for (int i = 0; i < 12; i++)
            put_f32_le(packet, NAN);
        return;
    }
    for (int i = 0; i < 3; i++)
        put_f32_le(packet, (float)(10000 * chance() - 5000));
    put_columns(packet);
}

/* Markers first, which are of no concern. */
static bool say_frame(struct made_up *qtm, uint32_t number)
{
    struct packet *packet = &qtm->packet;

    put_header(packet, 16 + 28 + 16 + 48 * BODIES, KIND_DATA);
    put_u64_le(packet, 1000000 + 10000 * (uint64_t)number);
    put_u32_le(packet, number);
    put_u32_le(packet, 2);
    put_u32_le(packet, 28);
    put_u32_le(packet, 1);
    put_u32_le(packet, 1);
    put_zeros(packet, 16);
    put_u32_le(packet, 16 + 48 * BODIES);
    put_u32_le(packet, 5);
    put_u32_le(packet, BODIES);
    put_zeros(packet, 4);
    for (int i = 0; i < BODIES; i++)
        put_body(packet);
    return say(qtm);
}

static bool play(struct made_up *qtm)
{
    static const struct capture_options options;
    static const char xml[] =
        "<QTM_Parameters_Ver_1.28>\n <The_6D>\n"
        "  <Body><Name>Robot1</Name><Mesh><Name>box</Name></Mesh></Body>\n"
        "  <Body>\n   <Name>Robot 2</Name>\n   <Color R=\"1\" G=\"2\" B=\"3\"/>\n  </Body>\n"
        "  <Body><Name>R&amp;D &lt;3&gt;</Name><Points><Point Name=\"p\"/></Points></Body>\n"
        "  <!-- <Body><Name>none</Name></Body> -->\n"
        "  <Body><Name>R\xC3\xB6"
        "bot4</Name></Body>\n  <Body><Name>5</Name></Body>\n"
        " </The_6D>\n</QTM_Parameters_Ver_1.28>";

    qtm_protocol.begin(qtm->session, &options);
    poses_write_header(qtm->poses);
    bool good = say_text(qtm, KIND_COMMAND, "QTM RT Interface connected") &&
                say_text(qtm, KIND_COMMAND, "Version set to 1.28") && say_text(qtm, KIND_XML, xml);
    for (uint32_t number = 0; good && number < FRAMES; number++)
        good = say_frame(qtm, number);
    return good;
}

int main(int argc, char **argv)
{
    static struct made_up qtm;

    if (argc != 3)
        return 2;
    qtm.session = malloc(qtm_protocol.session_bytes);
    qtm.stream = fopen(argv[1], "wb");
    qtm.poses = fopen(argv[2], "w");
    if (qtm.session == NULL || qtm.stream == NULL || qtm.poses == NULL)
        return 2;
    bool good = play(&qtm);
    free(qtm.session);
    return fclose(qtm.stream) == 0 && fclose(qtm.poses) == 0 && good ? 0 : 1;
}
