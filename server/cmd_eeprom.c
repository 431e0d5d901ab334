#include "arguments.h"
#include "commands.h"
#include "limits.h"
#include "parameters.h"

#include <argp.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct request {
    uint16_t id;
    const char *out;
};

enum { KEY_ID = 256, KEY_OUT };

static const struct argp_option option_table[] = {
    {"id", KEY_ID, "N", 0, "The robot's id, 1 to 65534", 0},
    {"out", KEY_OUT, "FILE", 0, "The Intel HEX file to write", 0},
    {0},
};

static error_t parse_option(int key, char *value, struct argp_state *state)
{
    struct request *request = state->input;

    switch (key) {
    case KEY_ID:
        request->id = (uint16_t)argument_number(state, "--id", value, 1, ROBOT_ID_MAX);
        break;
    case KEY_OUT: request->out = value; break;
    case ARGP_KEY_ARG: argp_error(state, "%s: only options are allowed", value); break;
    case ARGP_KEY_END:
        if (request->id == 0 || request->out == NULL)
            argp_error(state, "--id and --out are needed");
        break;
    default: return ARGP_ERR_UNKNOWN;
    }
    return 0;
}

/* One data record at address 0, and the end record. */
static void write_hex(FILE *file, const uint8_t *bytes, uint8_t count)
{
    uint8_t sum = count;

    fprintf(file, ":%02X000000", count);
    for (uint8_t i = 0; i < count; i++) {
        fprintf(file, "%02X", bytes[i]);
        sum = (uint8_t)(sum + bytes[i]);
    }
    fprintf(file, "%02X\n:00000001FF\n", (uint8_t)-sum);
}

static int work(const struct request *request)
{
    const struct parameters parameters = {request->id};
    uint8_t record[PARAMETERS_BYTES];
    FILE *file = fopen(request->out, "w");

    parameters_write(record, &parameters);
    if (file != NULL)
        write_hex(file, record, sizeof record);
    bool failed = file == NULL || ferror(file);
    if (file != NULL && fclose(file) != 0)
        failed = true;
    if (!failed)
        return STATUS_DONE;
    fprintf(stderr, "muster eeprom: cannot write %s: %s\n", request->out, strerror(errno));
    return STATUS_FAILED;
}

int cmd_eeprom(int argc, char **argv)
{
    static const struct argp argp = {
        option_table, parse_option,
        NULL,         "Write the EEPROM image that gives a robot its id, for an ISP programmer.",
        NULL,         NULL,
        NULL};
    struct request request = {0, NULL};

    argp_parse(&argp, argc, argv, 0, NULL, &request);
    return work(&request);
}
