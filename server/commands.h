/* commands.h: the subcommands of muster. Each takes its own part of the command line, argv[0]
 * being "muster NAME", and returns the exit status; wrong usage ends the program at once. */
#ifndef COMMANDS_H
#define COMMANDS_H

enum exit_status {
    STATUS_DONE = 0,
    STATUS_FAILED = 1, /* the work was begun and did not get done */
    STATUS_USAGE = 2,  /* wrong usage or input: nothing was begun */
};

int cmd_sim(int argc, char **argv);
int cmd_replay(int argc, char **argv);
int cmd_recover(int argc, char **argv);
int cmd_paper(int argc, char **argv);
int cmd_plot(int argc, char **argv);
int cmd_report(int argc, char **argv);
int cmd_serve(int argc, char **argv);
int cmd_check(int argc, char **argv);
int cmd_id(int argc, char **argv);
int cmd_param(int argc, char **argv);
int cmd_doctor(int argc, char **argv);
int cmd_capture(int argc, char **argv);
int cmd_flash(int argc, char **argv);
int cmd_robot(int argc, char **argv);
int cmd_arena(int argc, char **argv);
int cmd_calibrate(int argc, char **argv);
int cmd_eeprom(int argc, char **argv);
int cmd_video(int argc, char **argv);

#endif
