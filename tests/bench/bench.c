/* bench.c: `bench measure FILE.json` measures everything; `bench check RECORD` holds the exact
 * figures against the record, `bench accept RECORD` makes them the record. */
#include "accepted.h"
#include "benchmarks.h"
#include "results.h"

#include <err.h>
#include <stdlib.h>
#include <string.h>

struct step {
    const char *what;
    void (*measure)(void);
};

static const struct step exact_steps[] = {
    {"the arithmetic", measure_arithmetic}, {"the motion law", measure_law},
    {"allocation", measure_allocation},     {"frames", measure_frame},
    {"control ticks", measure_ticks},       {"plain control ticks", measure_plain_ticks},
    {"the images", measure_sizes},          {"the load of fleets", measure_loads},
};

static const struct step host_steps[] = {
    {"a simulated chip's memory", measure_robot_memory},
    {"the speed of simulations, for a minute or two", measure_speeds},
    {"what it costs to be looked at, for two minutes", measure_view},
    {"the server beside bare writes and a broker, for two minutes", measure_serve},
};

#define COUNT(array) (sizeof array / sizeof array[0])

static void take(const struct step *steps, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        fprintf(stderr, "measuring %s\n", steps[i].what);
        steps[i].measure();
    }
}

static void require_all(bool of_host)
{
    for (size_t i = 0; i < figure_count; i++)
        if (!figures[i].known && figures[i].of_host <= of_host)
            errx(EXIT_FAILURE, "%s could not be measured", figures[i].name);
}

static void write_json(const char *path)
{
    FILE *file = fopen(path, "w");

    if (file == NULL)
        err(EXIT_FAILURE, "%s", path);
    results_write_json(file);
    if (fclose(file) != 0)
        err(EXIT_FAILURE, "%s", path);
}

int main(int argc, char **argv)
{
    const char *verb = argc == 3 ? argv[1] : "";
    const char *path = argv[argc - 1];
    bool good = true;

    if (strcmp(verb, "measure") != 0 && strcmp(verb, "check") != 0 && strcmp(verb, "accept") != 0)
        errx(2, "usage: bench measure FILE.json | check RECORD | accept RECORD");
    take(exact_steps, COUNT(exact_steps));
    require_all(false);
    if (strcmp(verb, "check") == 0) {
        good = accepted_check(path);
    } else if (strcmp(verb, "accept") == 0) {
        accepted_write(path);
    } else {
        take(host_steps, COUNT(host_steps));
        require_all(true);
        results_print(stdout);
        write_json(path);
    }
    return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
