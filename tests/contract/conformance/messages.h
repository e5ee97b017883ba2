/* What spec/busservo.yaml says, for codec.c. Fields are numbers of 1 or 2 bytes, a list ends with a
   comma; then the size of a frame without elements and of an element, and how many there must be. */
typedef unsigned char byte;
static const struct message {
    const char *name; int way, id; const char *fields; int size, step, least;
} messages[] = {
    {"ServoMove", 0, 3, "time_ms=2 targets=1:2,", 7, 3, 1},
    {"ActionGroupRun", 0, 6, "group=1 times=2", 7, 0, 0},
    {"ActionGroupStop", 0, 7, "", 4, 0, 0},
    {"ActionGroupSpeed", 0, 11, "group=1 percent=2", 7, 0, 0},
    {"BatteryVoltageRead", 0, 15, "", 4, 0, 0},
    {"ServoUnload", 0, 20, "servo_ids=1,", 5, 1, 1},
    {"ServoPositionsRead", 0, 21, "servo_ids=1,", 5, 1, 1},
    {"ActionGroupStarted", 1, 6, "group=1 times=2", 7, 0, 0},
    {"ActionGroupStopped", 1, 7, "", 4, 0, 0},
    {"ActionGroupCompleted", 1, 8, "group=1 times=2", 7, 0, 0},
    {"BatteryVoltage", 1, 15, "voltage_mv=2", 6, 0, 0},
    {"ServoPositions", 1, 21, "positions=1:2,", 5, 3, 0},
    {NULL, 0, 0, NULL, 0, 0, 0},
};
