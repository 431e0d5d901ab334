/* newest.h: of frames that have come in one go, those that are still news.
 *
 * A frame is dropped when a later one speaks of all of its bodies. Where a system tells each body
 * by itself, every body's news gets through. */
#ifndef NEWEST_H
#define NEWEST_H

#include "capture.h"

struct newest {
    struct capture_frame frames[2];
    int blank; /* which of them is to be filled in next; the other is held, if any is */
    bool holding;
    int64_t arrival_us, displaced_us;
    uint64_t skipped;
};

/* Where the next frame is to be filled in. */
struct capture_frame *newest_blank(struct newest *newest);

/* The blank one has been filled in and is held now. Returns the one that was held before, for which
 * it is time now, or NULL; it is gone when the next blank one is asked for. */
const struct capture_frame *newest_hold(struct newest *newest, int64_t arrival_us);

/* The frame that is held, which no longer is, or NULL. Gone after the next newest_hold(). */
const struct capture_frame *newest_release(struct newest *newest);

#endif
