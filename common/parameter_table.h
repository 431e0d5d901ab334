/* parameter_table.h: every parameter of a robot, one line each. Firmware, host and documentation
 * are made from this table, and a parameter's place in it is its index on the link: lines are only
 * appended to each list.
 *
 * A value is a whole number: `per_unit` of them make one of `unit`. Stored ones have 16 bits, and
 * lie in the EEPROM in this order; readings have 32 and are the robot's own to change. */
#ifndef PARAMETER_TABLE_H
#define PARAMETER_TABLE_H

/* X(symbol, name, unit, per_unit, low, high, unless set, what it is), values as whole numbers */
#define PARAMETERS_STORED(X)                                                                       \
    X(ID, "id", "", 1, 0, 65534, 0, "the robot's id; 0: none, it never moves")                     \
    X(LEFT_GAIN, "left_gain", "", 16384, 8192, 24576, 16384,                                       \
      "how fast the left wheel is beside what the mission says of wheels")                         \
    X(RIGHT_GAIN, "right_gain", "", 16384, 8192, 24576, 16384,                                     \
      "how fast the right wheel is beside what the mission says of wheels")                        \
    X(LEFT_DEAD_BAND, "left_dead_band", "", 16383, 0, 4915, 0,                                     \
      "part of full PWM at which the left wheel begins to turn")                                   \
    X(RIGHT_DEAD_BAND, "right_dead_band", "", 16383, 0, 4915, 0,                                   \
      "part of full PWM at which the right wheel begins to turn")                                  \
    X(TRACK, "track", "m", 4000, 0, 8000, 0,                                                       \
      "distance between the wheels; 0: as the mission says")                                       \
    X(MOTOR_LAG, "motor_lag", "s", 1000, 0, 500, 0, "time constant of a wheel's speed")            \
    X(BATTERY_WARNING, "battery_warning", "V", 1000, 0, 30000, 6600,                               \
      "below it for 1 s, the robot warns; 0: never")                                               \
    X(BATTERY_CRITICAL, "battery_critical", "V", 1000, 0, 30000, 6200,                             \
      "below it for 1 s, the robot hands over and stops; 0: never")

/* X(symbol, name, unit, per_unit, what it is) */
#define PARAMETER_READINGS(X)                                                                      \
    X(IMAGE, "image", "", 1, "CRC-32 of the program, by which it is told from others")             \
    X(RESETS, "resets", "", 1, "resets since power-on, power-on not among them")                   \
    X(EEPROM, "eeprom", "", 1,                                                                     \
      "copies of the stored parameters that are whole: 2, 1, or 0, which makes all of them "       \
      "default")                                                                                   \
    X(UNSAVED, "unsaved", "", 1, "1: a save would change what is stored")

#define PARAMETER_SYMBOL(symbol, ...) PARAMETER_##symbol,
enum parameter {
    PARAMETERS_STORED(PARAMETER_SYMBOL) PARAMETERS_STORED_COUNT,

    /* Readings begin here, so that both lists can grow. */
    PARAMETERS_READ_FROM = 128,
    PARAMETERS_BEFORE_READINGS = PARAMETERS_READ_FROM - 1,
    PARAMETER_READINGS(PARAMETER_SYMBOL) PARAMETERS_END
};
#undef PARAMETER_SYMBOL

#endif
