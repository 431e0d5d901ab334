/* link_loss.h: what part of the frames on a robot's link was lost, from one look to the next. */
#ifndef LINK_LOSS_H
#define LINK_LOSS_H

#include "server.h"

/* All 0 before the first look. */
struct link_loss {
    uint32_t frames, bad_frames; /* at the last look */
};

/* 0 to 1, of the frames since the last look; 0 where there were none. */
double link_loss_look(struct link_loss *loss, const struct server_view *view);

#endif
