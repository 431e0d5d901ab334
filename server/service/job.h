/* job.h: what a command does with one robot over its link: bytes and time in, bytes out.
 *
 * A job is pure: it knows no clock, socket or file. A loop hands it what comes from its robot and
 * takes what goes there: session.h in real time, over the links of a site, rehearsal.h (sim/) in
 * virtual time, with simulated robots. All robots' jobs go on at once; none waits for another. */
#ifndef JOB_H
#define JOB_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define JOB_WORDS_MAX 160

enum job_state { JOB_WORKING, JOB_DONE, JOB_FAILED };

/* Where motion capture saw the robot. */
struct job_pose {
    double x, y, theta; /* m, rad */
    int64_t at_us;      /* when, by the same clock as `now_us` */
};

struct job;

struct job_kind {
    /* The link came up. */
    void (*linked)(struct job *job, int64_t now_us);
    /* It went down, `words` say why; it is dialled again as long as the job works. */
    void (*lost)(struct job *job, const char *words, int64_t now_us);
    /* Bytes from the robot. */
    void (*received)(struct job *job, const uint8_t *bytes, size_t count, int64_t now_us);
    /* A pose; NULL where none is wanted. */
    void (*seen)(struct job *job, const struct job_pose *pose);
    /* What is due for the robot now, at most `room` bytes (0 while the link is down or busy).
     * Called after each of the others and at least every TICK_MS, link or no link: here time
     * passes and patience ends. */
    size_t (*send)(struct job *job, int64_t now_us, uint8_t *bytes, size_t room);
};

struct job {
    const struct job_kind *kind;
    uint16_t robot; /* the id by the site; 0: not known */
    enum job_state state;
    double progress; /* 0 to 1 */
    char
        words[JOB_WORDS_MAX]; /* what goes on; once it has ended what came out, or what was wrong */
};

/* Ends it, with words. */
void job_done(struct job *job, const char *format, ...) __attribute__((format(printf, 2, 3)));
void job_failed(struct job *job, const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif
