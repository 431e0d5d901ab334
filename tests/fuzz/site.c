/* Any bytes as a site file: it is refused with one line that says where and why, or what is read of
 * it keeps its promises. */
#include "site.h"

#include <assert.h>
#include <math.h>
#include <string.h>

static void look_at_refusal(const char *error)
{
    assert(strncmp(error, "d/f.yaml:", 9) == 0);
    assert(strstr(error, ": error: ") != NULL);
    assert(strchr(error, '\n') == NULL);
}

static void look_at_mocap(const struct site *site)
{
    const struct source_settings *mocap = &site->mocap;

    assert(mocap->protocol != NULL);
    assert((mocap->file != NULL) == (mocap->protocol == &poses_protocol));
    assert(mocap->file == NULL || mocap->file[0] == '/' || strncmp(mocap->file, "d/", 2) == 0);
    assert(!mocap->options.unicast || (mocap->server != NULL && mocap->group == NULL));
    assert(site->tracker.scale > 0 && site->tracker.jump >= 0 && site->tracker.latency >= 0);
}

static void look_at_robot(const struct site_robot *robot)
{
    assert(robot->id >= 1);
    assert(robot->name[0] != '\0' && strlen(robot->name) < CAPTURE_NAME_MAX);
    assert(isfinite(robot->heading));
    assert(robot->link.baud > 0);
    assert(robot->link.adapter == -1 || robot->link.address.kind == LINK_RFCOMM);
}

static void look_at(const struct site *site)
{
    assert(site->name[0] != '\0' && strchr(site->name, '/') == NULL);
    look_at_mocap(site);
    assert(site->robot_count >= 1 && site->robot_count <= CAPTURE_BODIES_MAX);
    for (size_t i = 0; i < site->robot_count; i++)
        look_at_robot(&site->robots[i]);
    assert(!site->fenced || (site->fence[0] < site->fence[2] && site->fence[1] < site->fence[3]));
    assert(site->separation >= 0 && site->battery >= 0 && site->patience >= 0);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char error[512] = "";
    struct site *site =
        site_parse("d/f.yaml", (const char *)data, size, NULL, 0, error, sizeof error);

    if (site == NULL)
        look_at_refusal(error);
    else
        look_at(site);
    site_free(site);
    return 0;
}
