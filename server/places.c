#include "places.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* The folder of installed data, found from this program's own file: a prefix may be moved, and a
 * package is unpacked in another one than it was built for. False when there is none. */
static bool find_installed(char path[PLACE_MAX])
{
    char beside[PLACE_MAX];
    ssize_t length =
        readlink("/proc/self/exe", beside, sizeof beside - sizeof "/" MUSTER_DATA_FROM_BIN);

    if (length < 0)
        return false;
    beside[length] = '\0';

    char *slash = strrchr(beside, '/');
    if (slash == NULL)
        return false;
    strcpy(slash, "/" MUSTER_DATA_FROM_BIN);
    return realpath(beside, path) != NULL;
}

static const char *find(char path[PLACE_MAX], const char *installed, const char *built)
{
    if (find_installed(path) && strlen(path) + strlen(installed) < PLACE_MAX)
        strcat(path, installed);
    else
        snprintf(path, PLACE_MAX, "%s", built);
    return path;
}

const char *place_firmware(char path[PLACE_MAX])
{
    return find(path, "/muster.elf", MUSTER_BUILT_FIRMWARE);
}

const char *place_loader(char path[PLACE_MAX])
{
    return find(path, "/loader.elf", MUSTER_BUILT_LOADER);
}

const char *place_scenarios(char path[PLACE_MAX])
{
    return find(path, "/scenarios", MUSTER_BUILT_SCENARIOS);
}
