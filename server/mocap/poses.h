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

/* Whether it could be written is what ferror() says. Frames of one recording differ in `t` by 1 us
 * at least, or they are one. Control characters in names become `_`. */
void poses_write_header(FILE *out);
void poses_write_frame(FILE *out, double t, const struct capture_frame *frame);

#endif
