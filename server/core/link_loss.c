#include "link_loss.h"

#include <math.h>

double link_loss_look(struct link_loss *loss, const struct server_view *view)
{
    uint32_t frames = view->frames - loss->frames;
    uint32_t bad = view->bad_frames - loss->bad_frames;
    bool anew = view->frames < loss->frames; /* counts begin anew with a link */

    *loss = (struct link_loss){view->frames, view->bad_frames};
    return anew || frames + bad == 0 ? 0 : fmin(1, (double)bad / (double)(frames + bad));
}
