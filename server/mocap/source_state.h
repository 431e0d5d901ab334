/* source_state.h: what the files of a source share: source.c opens and closes, intake.c takes what
 * comes, replay.c paces a file, standing.c judges and tells how it stands. */
#ifndef SOURCE_STATE_H
#define SOURCE_STATE_H

#include "natnet.h"
#include "newest.h"
#include "socket.h"
#include "source.h"

#include <stddef.h>

#define SOURCE_WORDS_MAX 384
#define SOURCE_SILENCE_US 1000000 /* so long without a frame, and it is said */
#define SOURCE_ANEW_US 5000000    /* so long, and groups are joined and streams opened anew */

enum source_kind {
    SOURCE_FILE,
    SOURCE_STREAM,   /* TCP */
    SOURCE_ASKED,    /* UDP, and the system is spoken to */
    SOURCE_LISTENED, /* UDP, and it is not */
};

enum standing {
    STANDING_NOTHING,  /* has been heard since it was opened */
    STANDING_ANSWERED, /* it has said who it is, or is connected: no frame yet */
    STANDING_FLOWING,
    STANDING_SILENT, /* no more */
    STANDING_REFUSED,
    STANDING_ENDED, /* the file */
};

/* A descriptor of a source; -1 while it is closed. */
struct channel {
    struct watch watch; /* first: its address is the channel's */
    struct source *source;
    int64_t empty_us; /* when nothing was waiting in it last */
};

struct replay {
    int file;
    bool pending;   /* the blank frame is filled in and waits until it is due */
    bool begun;     /* first_s and first_us are known */
    double first_s; /* time of the frame that the pace counts from, and when it was due */
    int64_t first_us, due_us;
};

struct source {
    struct loop *loop;
    const struct source_settings *settings;
    const struct source_owner *owner;
    enum source_kind kind;
    struct sockaddr_in system; /* sin_family 0: any */
    struct socket_interface interface;

    struct channel command;   /* asks and is answered; a stream */
    struct channel data;      /* the group or port that is listened to */
    struct channel timer;     /* of a file */
    struct sockaddr_in group; /* joined by `data`; sin_family 0: none */
    struct replay replay;
    bool connecting;
    int64_t opened_us, data_opened_us, retry_us, backoff_us;

    enum standing standing;
    int64_t standing_us;           /* since when */
    bool complained;               /* that it stands so */
    char told[CAPTURE_WORDS_MAX];  /* by the system of itself */
    char amiss[CAPTURE_WORDS_MAX]; /* what could not be understood last, since a frame came */
    char said[SOURCE_WORDS_MAX];   /* the last problem */
    char words[SOURCE_WORDS_MAX];
    struct sockaddr_in stranger; /* somebody else who has sent something; sin_family 0: nobody */

    struct newest newest;
    bool numbered;
    uint32_t number;
    int64_t anew_us;  /* when numbers began anew last */
    int64_t frame_us; /* when the last one was told */
    uint64_t frames, broken;
    uint64_t rate_frames; /* as counted at rate_us */
    int64_t rate_us;
    double rate; /* Hz */

    size_t waiting; /* bytes of the stream or file, for their rest */
    uint8_t stream[CAPTURE_MESSAGE_MAX];
    uint8_t datagram[CAPTURE_MESSAGE_MAX];
    max_align_t session[];
};

/* source.c */
void source_lost(struct source *source, const char *why); /* closes; to be opened anew */
void source_ask(struct source *source, int64_t now_us);

/* intake.c: for watches. */
void intake_datagrams(struct watch *watch, uint32_t events);
void intake_stream(struct watch *watch, uint32_t events);

/* What the protocol says of bytes that have come at `arrival_us`. Returns how many are done with;
 * `whole` turns false when it could not understand them. */
size_t intake_feed(struct source *source, const uint8_t *bytes, size_t count, int64_t arrival_us,
                   bool *whole);

/* Holds the blank frame, unless it was overtaken, and tells the one that it displaces. */
void intake_frame(struct source *source, int64_t arrival_us);

/* Tells the frame that is held: nothing newer is there. */
void intake_flush(struct source *source);

/* replay.c. False with words when the file cannot be opened. */
bool replay_open(struct source *source, char *error, size_t room);
void replay_close(struct source *source);

/* standing.c */
void standing_set(struct source *source, enum standing standing, int64_t now_us);
void standing_frame(struct source *source, int64_t now_us); /* one is told now */
void standing_judge(struct source *source, int64_t now_us);

/* The protocol's name goes before. A problem that was said last is not said again. */
__attribute__((format(printf, 2, 3))) void standing_say(struct source *source, const char *format,
                                                        ...);
__attribute__((format(printf, 2, 3))) void standing_complain(struct source *source,
                                                             const char *format, ...);

#endif
