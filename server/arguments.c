#include "arguments.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

uint64_t argument_number(struct argp_state *state, const char *option, const char *text,
                         uint64_t low, uint64_t high)
{
    char *end;

    errno = 0;
    uint64_t value = strtoull(text, &end, 10);
    bool digits = text[0] >= '0' && text[0] <= '9' && *end == '\0';
    if (!digits || errno != 0 || value < low || value > high)
        argp_error(state, "%s %s: a whole number from %llu to %llu is allowed", option, text,
                   (unsigned long long)low, (unsigned long long)high);
    return value;
}

double argument_speed(struct argp_state *state, const char *text)
{
    char *end;
    double speed = strtod(text, &end);

    if (strcmp(text, "max") == 0)
        return 0;
    /* Written so that it is false for what is no number. */
    if (end == text || *end != '\0' || !(speed >= ACT_SPEED_MIN && speed <= ACT_SPEED_MAX))
        argp_error(state, "--speed %s: %g to %g times real time, or max, is allowed", text,
                   ACT_SPEED_MIN, ACT_SPEED_MAX);
    return speed;
}

void argument_view(struct argp_state *state, char *place, struct view_options *options)
{
    char error[256];

    if (!view_place(options, place, error, sizeof error))
        argp_error(state, "--view: %s", error);
}

enum sim_robots argument_robots(struct argp_state *state, const char *text)
{
    if (strcmp(text, "avr") != 0 && strcmp(text, "native") != 0)
        argp_error(state, "--robots %s: avr or native is allowed", text);
    return strcmp(text, "avr") == 0 ? SIM_AVR : SIM_NATIVE;
}

unsigned argument_threads_default(void)
{
    long count = sysconf(_SC_NPROCESSORS_ONLN);

    return count < 1 ? 1 : count > THREADS_MAX ? THREADS_MAX : (unsigned)count;
}

bool argument_firmware_exists(const char *command, enum sim_robots robots, const char *firmware)
{
    if (robots != SIM_AVR || access(firmware, R_OK) == 0)
        return true;
    fprintf(stderr,
            "muster %s: no firmware for the robots, %s: %s\n"
            "`make firmware' builds it; --robots native runs without.\n",
            command, firmware, strerror(errno));
    return false;
}
