/* onlookers.h: those who look on by a view (view.h), told of a run. */
#ifndef ONLOOKERS_H
#define ONLOOKERS_H

#include "record.h"
#include "steer.h"
#include "view.h"

/* What a record shows goes to the view. Nobody where there is none. */
struct audience onlookers_audience(struct view *view);

/* Says how it stands. The formations are all that there are now. */
void onlookers_status(struct view *view, const struct steer *steer, struct view_status status);

#endif
