#include "act.h"

const char *const act_words[ACT_COUNT] = {
    [ACT_KILL] = "kill",   [ACT_REVIVE] = "revive",       [ACT_STALL] = "stall",
    [ACT_MUTE] = "mute",   [ACT_UNMUTE] = "unmute",       [ACT_DRAIN] = "drain",
    [ACT_MOVE] = "move",   [ACT_FORMATION] = "formation", [ACT_DRAW] = "draw",
    [ACT_ESTOP] = "estop", [ACT_BEGIN] = "begin",         [ACT_END] = "end",
    [ACT_PAUSE] = "pause", [ACT_RESUME] = "resume",       [ACT_STEP] = "step",
    [ACT_SPEED] = "speed",
};
