/* recovery.h: a recording that was cut short made whole: all of its whole chunks, index, footer. */
#ifndef RECOVERY_H
#define RECOVERY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct recovery {
    bool whole; /* it was so already: without `out` it has been left alone */
    uint64_t messages;
    double seconds; /* mission time of the last one */
    size_t damaged; /* chunks that were left out: not the last one, which was torn */
};

enum recovery_end {
    RECOVERY_DONE,
    RECOVERY_REFUSED, /* it is no recording, or is being written */
    RECOVERY_FAILED,
};

/* `path` is a run's folder or an MCAP file; `out` what is written, NULL: that file itself. It is
 * written beside and takes its place when the disk has it, so that there is one of the two at any
 * moment. Words in `error` unless done. */
enum recovery_end recovery_run(const char *path, const char *out, struct recovery *recovery,
                               char *error, size_t room);

#endif
