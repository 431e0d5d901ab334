#include "commands.h"
#include "text.h"

#include <argp.h>
#include <locale.h>
#include <stdio.h>
#include <string.h>

static const struct {
    const char *name;
    int (*run)(int argc, char **argv);
    const char *does;
} commands[] = {
    {"sim", cmd_sim, "run a scenario in virtual time"},
    {"replay", cmd_replay, "show the recording of a run"},
    {"plot", cmd_plot, "compare runs in one figure"},
    {"report", cmd_report, "tell of runs on one page"},
    {"video", cmd_video, "make an animated picture of a run"},
    {"recover", cmd_recover, "make a recording whole that was cut short"},
    {"paper", cmd_paper, "make the paper's figures again, and judge its claims by them"},
    {"serve", cmd_serve, "lead real robots through a scenario"},
    {"check", cmd_check, "look whether an arena is ready for that"},
    {"flash", cmd_flash, "give robots another program over their links"},
    {"id", cmd_id, "give robots their ids"},
    {"param", cmd_param, "read and change robots' parameters"},
    {"calibrate", cmd_calibrate, "measure robots' wheels and give them their parameters"},
    {"doctor", cmd_doctor, "look robots over: links, batteries, memory, programs"},
    {"capture", cmd_capture, "record what motion capture says, and show which bodies it has"},
    {"robot", cmd_robot, "be a virtual robot in real time, behind a link"},
    {"arena", cmd_arena, "move virtual robots in real time, and be their motion capture"},
    {"eeprom", cmd_eeprom, "write the EEPROM image that gives a robot its id"},
};

#define COMMAND_COUNT (sizeof commands / sizeof commands[0])

static void print_help(FILE *out)
{
    fprintf(out, "Usage: muster COMMAND [OPTION...]\n"
                 "Teams of mobile robots that form up and outlive the loss of any member.\n\n");
    for (size_t i = 0; i < COMMAND_COUNT; i++)
        fprintf(out, "  %-11s%s\n", commands[i].name, commands[i].does);
    fprintf(out, "\n"
                 "  --help     this text; `muster COMMAND --help' tells of a command's options\n"
                 "  --version  the version\n\n"
                 "Exit status: 0 done, 1 the run failed, 2 wrong usage or input.\n");
}

static int refuse_command(const char *name)
{
    const char *names[COMMAND_COUNT + 1] = {NULL};

    for (size_t i = 0; i < COMMAND_COUNT; i++)
        names[i] = commands[i].name;

    const char *nearest = text_nearest(name, names);
    fprintf(stderr, "muster: unknown %s '%s'", name[0] == '-' ? "option" : "command", name);
    if (nearest != NULL)
        fprintf(stderr, ", perhaps '%s'", nearest);
    fprintf(stderr, "\nTry `muster --help' for what there is.\n");
    return STATUS_USAGE;
}

int main(int argc, char **argv)
{
    char title[32];

    /* Numbers in files are written and read with a point, wherever the user is at home. */
    setlocale(LC_NUMERIC, "C");
    argp_err_exit_status = STATUS_USAGE;
    if (argc < 2) {
        print_help(stderr);
        return STATUS_USAGE;
    }
    if (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0) {
        print_help(stdout);
        return STATUS_DONE;
    }
    if (strcmp(argv[1], "--version") == 0) {
        puts("muster " MUSTER_VERSION);
        return STATUS_DONE;
    }
    for (size_t i = 0; i < COMMAND_COUNT; i++) {
        if (strcmp(argv[1], commands[i].name) != 0)
            continue;
        snprintf(title, sizeof title, "muster %s", commands[i].name);
        argv[1] = title;
        return commands[i].run(argc - 1, argv + 1);
    }
    return refuse_command(argv[1]);
}
