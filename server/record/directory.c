#include "directory.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static bool make(char *path, char *error, size_t room)
{
    for (char *slash = path; slash != NULL;) {
        slash = strchr(slash + 1, '/');
        if (slash != NULL)
            *slash = '\0';
        if (mkdir(path, 0777) != 0 && errno != EEXIST) {
            snprintf(error, room, "cannot make the directory %s: %s", path, strerror(errno));
            return false;
        }
        if (slash != NULL)
            *slash = '/';
    }
    return true;
}

static void remove_old_files(const char *dir)
{
    static const char *const names[] = {"trace.csv",          "run.mcap",     "routes.svg",
                                        "routes.png",         "summary.json", "distance_error.svg",
                                        "distance_error.png", "report.html"};
    char path[4096];

    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        if (snprintf(path, sizeof path, "%s/%s", dir, names[i]) < (int)sizeof path)
            remove(path);
}

bool directory_prepare(const char *dir, char *error, size_t room)
{
    char *path = strdup(dir);

    if (path == NULL) {
        snprintf(error, room, "no memory");
        return false;
    }
    bool made = make(path, error, room);
    free(path);
    if (made)
        remove_old_files(dir);
    return made;
}
