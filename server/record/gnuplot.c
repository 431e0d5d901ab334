#define _GNU_SOURCE /* posix_spawn_file_actions_addchdir_np */

#include "gnuplot.h"

#include <errno.h>
#include <fcntl.h>
#include <spawn.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

const unsigned gnuplot_colours[GNUPLOT_COLOURS] = {0x0072B2, 0xD55E00, 0x009E73, 0xCC79A7,
                                                   0xE69F00, 0x56B4E9, 0x882255, 0x117733};

/* 0 or an errno. */
static int spawn(const char *dir, FILE *script, FILE *words, pid_t *child)
{
    char *arguments[] = {"gnuplot", "--default-settings", "-", NULL};
    posix_spawn_file_actions_t actions;
    int failed = posix_spawn_file_actions_init(&actions);

    if (failed != 0)
        return failed;
    posix_spawn_file_actions_addchdir_np(&actions, dir);
    posix_spawn_file_actions_adddup2(&actions, fileno(script), STDIN_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, fileno(words), STDERR_FILENO);
    failed = posix_spawnp(child, arguments[0], &actions, NULL, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    return failed;
}

static bool refuse(char *error, size_t room, const char *reason)
{
    snprintf(error, room, "%s", reason);
    return false;
}

static bool run(const char *dir, FILE *script, FILE *words, char *error, size_t room)
{
    char line[256] = "gnuplot failed and did not say why";
    pid_t child;
    int status;
    int failed = spawn(dir, script, words, &child);

    if (failed == ENOENT)
        return refuse(error, room, "gnuplot is not installed (Debian: gnuplot-nox)");
    if (failed != 0)
        return refuse(error, room, strerror(failed));
    while (waitpid(child, &status, 0) < 0) {
        if (errno != EINTR)
            return refuse(error, room, strerror(errno));
    }
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0)
        return true;
    rewind(words);
    while (fgets(line, sizeof line, words) != NULL && line[0] == '\n')
        continue;
    line[strcspn(line, "\n")] = '\0';
    return refuse(error, room, line);
}

bool gnuplot_run(const char *dir, FILE *script, char *error, size_t room)
{
    if (access(dir, W_OK | X_OK) != 0)
        return refuse(error, room, strerror(errno));
    FILE *words = tmpfile();
    if (words == NULL)
        return refuse(error, room, strerror(errno));
    rewind(script);
    bool good = ferror(script) ? refuse(error, room, strerror(errno))
                               : run(dir, script, words, error, room);
    fclose(words);
    return good;
}
