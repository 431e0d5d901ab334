#include "lookout.h"

static int16_t to_scale(const struct lookout *lookout, int32_t part)
{
    if (lookout->byte)
        part >>= 8;
    return (int16_t)(lookout->by == 0 ? part : mul24_high(part, lookout->by));
}

struct vec16 lookout_see(const struct lookout *lookout, struct vec32 offset)
{
    struct vec16 near = {to_scale(lookout, offset.x), to_scale(lookout, offset.y)};

    return vec_rotate_back(near, lookout->heading);
}
