/* id.h: which robot is to get which id, judged by what all of them say. Pure. */
#ifndef ID_H
#define ID_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum id_verdict {
    ID_SILENT, /* nothing is known of it */
    ID_KEEPS,  /* what it has is right */
    ID_GETS,   /* `gets` */
    ID_OTHER,  /* it has another one than the site says, and is left alone */
    ID_TAKEN,  /* it would get one that the robot `twin` has, and is left alone */
    ID_TWICE,  /* it has the same as the robot `twin`, and is left alone */
};

struct id_link {
    uint16_t wanted; /* by the site; 0: any that is free */
    bool answered;
    uint16_t has; /* 0: none */

    enum id_verdict verdict;
    uint16_t gets;
    size_t twin; /* the other link that says it has that id; its own place: there is none */
};

/* Ids that are free are given in a row from `first` on. `force`: robots that have one get another
 * as those that have none. */
void id_judge(struct id_link *links, size_t count, uint16_t first, bool force);

#endif
