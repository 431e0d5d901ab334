#include "arguments.h"
#include "commands.h"
#include "limits.h"
#include "parameters.h"

#include <argp.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define RECORD_BYTES 16 /* of an Intel HEX record: what every programmer takes */

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

static void write_record(FILE *file, uint8_t address, const uint8_t *bytes, uint8_t count)
{
    uint8_t sum = (uint8_t)(count + address);

    fprintf(file, ":%02X00%02X00", count, address);
    for (uint8_t i = 0; i < count; i++) {
        fprintf(file, "%02X", bytes[i]);
        sum = (uint8_t)(sum + bytes[i]);
    }
    fprintf(file, "%02X\n", (uint8_t)-sum);
}

static void write_hex(FILE *file, const uint8_t eeprom[PARAMETERS_BYTES])
{
    for (uint8_t at = 0; at < PARAMETERS_BYTES; at += RECORD_BYTES)
        write_record(file, at, eeprom + at, RECORD_BYTES);
    fprintf(file, ":00000001FF\n");
}

static int work(const struct request *request)
{
    struct parameters parameters;
    uint8_t eeprom[PARAMETERS_BYTES];
    FILE *file = fopen(request->out, "w");

    parameters_default(&parameters);
    parameters.value[PARAMETER_ID] = request->id;
    parameters_write(eeprom, &parameters);
    if (file != NULL)
        write_hex(file, eeprom);
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
        option_table,
        parse_option,
        NULL,
        "Write the EEPROM image that gives a robot its id, and of every other parameter the "
        "default, for an ISP programmer.",
        NULL,
        NULL,
        NULL};
    struct request request = {0, NULL};

    argp_parse(&argp, argc, argv, 0, NULL, &request);
    return work(&request);
}
