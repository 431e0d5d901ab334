/* poses.h: recorded poses, as `muster capture` writes them and the protocol `poses` reads them.
 *
 * CSV whose first line is POSES_HEADER and whose others are a body each: `t` in s since the start
 * of the recording, never decreasing; the body's name, quoted where it holds a comma or a quote;
 * its number or nothing; place in m and unit quaternion in the system's axes; tracked, 0 or 1.
 * Consecutive lines with the same `t` are one frame, whose time is `t`.
 *
 * A frame is known to be whole by what comes behind it: its last one is told when take() gets 0
 * bytes, which says that the file is at its end. A last line without its line feed is not read. */
#ifndef POSES_H
#define POSES_H

#include "capture.h"

#include <stdio.h>

#define POSES_HEADER "t,body,id,x,y,z,qx,qy,qz,qw,tracked"

/* Whether it could be written is what ferror() says. Control characters in names become `_`. */
void poses_write_header(FILE *out);
void poses_write_frame(FILE *out, int64_t t_us, const struct capture_frame *frame);

/* The clock of a recording, which begins zeroed. */
struct poses_clock {
    bool begun;
    double time;
    int64_t arrival_us;
    int64_t t_us;
};

/* The `t` of the next frame, in us. It goes on as the system's own clock does, for it knows when a
 * frame was measured; by the time of arrival where the system tells no time, or one that is more
 * than 1 s off. Every frame is 1 us later than the one before at least, or they would be one. */
int64_t poses_clock_next(struct poses_clock *clock, const struct capture_frame *frame,
                         int64_t arrival_us);

#endif
