#include "site.h"

#include "scenario.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unity.h>

/* A good file; the tests spoil or extend a line of it. */
static const char *const good[] = {
    "schema: 1",
    "name: lab",
    "mocap: {protocol: natnet, server: 10.0.0.5}",
    "robots:",
    "  - {id: 1, link: \"rfcomm:00:14:03:05:59:02\"}",
    "  - {id: 7, link: \"tty:/dev/ttyUSB0\"}",
    "patience: 10",
};

enum { NAME = 2, MOCAP, FIRST_ROBOT = 5, ROBOT, LAST };

#define GOOD_LINES (sizeof good / sizeof good[0])

static struct site *site;
static char error[1024];
static char text[65536];

void setUp(void)
{
    site = NULL;
    error[0] = '\0';
}

void tearDown(void)
{
    site_free(site);
}

/* The good file with line `number` (from 1) replaced; 0: as it is. */
static const char *with_line(size_t number, const char *line)
{
    text[0] = '\0';
    for (size_t i = 0; i < GOOD_LINES; i++) {
        strcat(text, i + 1 == number ? line : good[i]);
        strcat(text, "\n");
    }
    return text;
}

static void parse(const char *file, const char *setting)
{
    site_free(site);
    site = site_parse(file, text, strlen(text), &setting, setting != NULL, error, sizeof error);
}

static void accept(size_t number, const char *line)
{
    with_line(number, line);
    parse("f.yaml", NULL);
    TEST_ASSERT_NOT_NULL_MESSAGE(site, error);
}

/* `expected` is the beginning of the error's line. */
static void refuse(size_t number, const char *line, const char *expected)
{
    char begin[sizeof error];

    with_line(number, line);
    parse("f.yaml", NULL);
    TEST_ASSERT_NULL_MESSAGE(site, line);
    snprintf(begin, strlen(expected) + 1, "%s", error);
    TEST_ASSERT_EQUAL_STRING(expected, begin);
    TEST_ASSERT_NULL_MESSAGE(strchr(error, '\n'), "an error is one line");
}

static void assert_near(double expected, double value)
{
    TEST_ASSERT_TRUE(fabs(value - expected) < 1e-12);
}

static void test_what_a_file_leaves_out(void)
{
    accept(0, NULL);
    TEST_ASSERT_EQUAL_STRING("lab", site->name);
    TEST_ASSERT_NULL(site->scenario);
    TEST_ASSERT_TRUE(isnan(site->range) && isnan(site->loss) && isnan(site->delay));
    TEST_ASSERT_TRUE(isnan(site->track) && isnan(site->wheel_max) && isnan(site->latency));
    TEST_ASSERT_FALSE(site->fenced);
    assert_near(0, site->separation);
    assert_near(0, site->battery);
    assert_near(10, site->patience);
    assert_near(1, site->tracker.scale);
    assert_near(0.3, site->tracker.jump);
    assert_near(0, site->tracker.latency);
}

static void test_what_a_robot_leaves_out(void)
{
    accept(0, NULL);
    TEST_ASSERT_EQUAL_UINT(2, site->robot_count);
    TEST_ASSERT_EQUAL_UINT(7, site->robots[1].id);
    TEST_ASSERT_EQUAL_STRING("Robot7", site->robots[1].name);
    TEST_ASSERT_EQUAL_INT32(CAPTURE_ID_NONE, site->robots[1].body);
    assert_near(0, site->robots[1].heading);
    TEST_ASSERT_EQUAL_INT(-1, site->robots[1].link.adapter);
    TEST_ASSERT_EQUAL_UINT32(115200, site->robots[1].link.baud);
    TEST_ASSERT_EQUAL_INT(LINK_TTY, site->robots[1].link.address.kind);
    TEST_ASSERT_EQUAL_STRING("/dev/ttyUSB0", site->robots[1].link.address.name);
}

static void test_what_a_robot_may_have(void)
{
    accept(FIRST_ROBOT,
           "  - {id: 65534, body: \"Blue Cart\", link: \"rfcomm:00:14:03:05:59:02/3\", "
           "adapter: hci15, heading: -pi/2, body_id: 12, baud: 9600}");
    TEST_ASSERT_EQUAL_UINT(65534, site->robots[0].id);
    TEST_ASSERT_EQUAL_STRING("Blue Cart", site->robots[0].name);
    TEST_ASSERT_EQUAL_INT32(12, site->robots[0].body);
    assert_near(-M_PI / 2, site->robots[0].heading);
    TEST_ASSERT_EQUAL_INT(15, site->robots[0].link.adapter);
    TEST_ASSERT_EQUAL_UINT32(9600, site->robots[0].link.baud);
    TEST_ASSERT_EQUAL_INT(LINK_RFCOMM, site->robots[0].link.address.kind);
    TEST_ASSERT_EQUAL_UINT8(0x14, site->robots[0].link.address.bluetooth[1]);
    TEST_ASSERT_EQUAL_UINT8(3, site->robots[0].link.address.channel);
}

static void test_a_body_that_has_a_number_needs_no_name(void)
{
    accept(FIRST_ROBOT, "  - {id: 8, link: \"tty:/dev/ttyUSB9\", body_id: 0}");
    TEST_ASSERT_NULL(site->robots[0].name);
    TEST_ASSERT_EQUAL_INT32(0, site->robots[0].body);
    refuse(ROBOT,
           "  - {id: 3, link: \"tcp:h:4000\", body_id: 4}\n"
           "  - {id: 3, link: \"tcp:h:4001\", body_id: 5}",
           "f.yaml:7:10: error: robots 'by number' and 'by number' have the same id 3; each has its "
           "own");
}

static void test_what_the_arena_may_have(void)
{
    accept(LAST, "network: {range: 3, loss: 0.1, delay: 0.02}\n"
                 "wheels: {track: 0.08, max: 0.6}\n"
                 "latency: 0.025\n"
                 "fence: [-2, -3, 4, 5]\n"
                 "separation: 0.12\n"
                 "battery: 6.6\n"
                 "patience: 0");
    assert_near(3, site->range);
    assert_near(0.1, site->loss);
    assert_near(0.02, site->delay);
    assert_near(0.08, site->track);
    assert_near(0.6, site->wheel_max);
    assert_near(0.025, site->latency);
    TEST_ASSERT_TRUE(site->fenced);
    assert_near(-2, site->fence[0]);
    assert_near(-3, site->fence[1]);
    assert_near(4, site->fence[2]);
    assert_near(5, site->fence[3]);
    assert_near(0.12, site->separation);
    assert_near(6.6, site->battery);
    assert_near(0, site->patience);
}

static void test_every_protocol_has_a_name(void)
{
    static const struct {
        const char *line;
        const struct capture_protocol *protocol;
        enum tracker_up up;
    } cases[] = {
        {"mocap: {protocol: natnet, server: h}", &natnet_protocol, UP_Y},
        {"mocap: {protocol: natnet, version: 3.0, up: z}", &natnet_protocol, UP_Z},
        {"mocap: {protocol: vrpn, server: h}", &vrpn_protocol, UP_Z},
        {"mocap: {protocol: vicon}", &vicon_protocol, UP_Z},
        {"mocap: {up: y, protocol: vicon}", &vicon_protocol, UP_Y},
        {"mocap: {protocol: qtm, server: h}", &qtm_protocol, UP_Z},
        {"mocap: {protocol: dtrack, port: 5001}", &dtrack_protocol, UP_Z},
        {"mocap: {protocol: poses, file: p.csv}", &poses_protocol, UP_Z},
    };

    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        accept(MOCAP, cases[i].line);
        TEST_ASSERT_EQUAL_PTR(cases[i].protocol, site->mocap.protocol);
        TEST_ASSERT_EQUAL_INT(cases[i].up, site->tracker.up);
    }
}

static void test_what_natnet_may_have(void)
{
    accept(MOCAP, "mocap: {protocol: natnet, server: motive.lan, port: 1610, interface: eth0, "
                  "group: 239.255.42.98, version: \"2.11\", data_port: 1611, up: z, scale: 0.001, "
                  "jump: 0, latency: 0.005}");
    TEST_ASSERT_EQUAL_STRING("motive.lan", site->mocap.server);
    TEST_ASSERT_EQUAL_UINT(1610, site->mocap.port);
    TEST_ASSERT_EQUAL_STRING("eth0", site->mocap.interface);
    TEST_ASSERT_EQUAL_STRING("239.255.42.98", site->mocap.group);
    TEST_ASSERT_EQUAL_UINT8(2, site->mocap.options.version[0]);
    TEST_ASSERT_EQUAL_UINT8(11, site->mocap.options.version[1]);
    TEST_ASSERT_EQUAL_UINT(1611, site->mocap.options.data_port);
    TEST_ASSERT_FALSE(site->mocap.options.unicast);
    TEST_ASSERT_EQUAL_INT(UP_Z, site->tracker.up);
    assert_near(0.001, site->tracker.scale);
    assert_near(0, site->tracker.jump);
    assert_near(0.005, site->tracker.latency);
    accept(MOCAP, "mocap: {protocol: natnet, version: 3.0, unicast: true}");
    accept(MOCAP, "mocap: {protocol: natnet, server: h, unicast: true}");
    TEST_ASSERT_TRUE(site->mocap.options.unicast);
    TEST_ASSERT_EQUAL_UINT(0, site->mocap.port);
}

static void test_paths_begin_at_the_files_folder(void)
{
    with_line(MOCAP, "mocap: {protocol: poses, file: /var/p.csv, repeat: true}\nscenario: s.yaml");
    parse("f.yaml", NULL);
    TEST_ASSERT_NOT_NULL_MESSAGE(site, error);
    TEST_ASSERT_EQUAL_STRING("s.yaml", site->scenario);
    TEST_ASSERT_EQUAL_STRING("/var/p.csv", site->mocap.file);
    TEST_ASSERT_TRUE(site->mocap.repeat);
    parse("a/b.c/f.yaml", NULL);
    TEST_ASSERT_EQUAL_STRING("a/b.c/s.yaml", site->scenario);
    TEST_ASSERT_EQUAL_STRING("/var/p.csv", site->mocap.file);
    parse("/f.yaml", NULL);
    TEST_ASSERT_EQUAL_STRING("/s.yaml", site->scenario);
    parse("a/f.yaml", "scenario=my/own.yaml");
    TEST_ASSERT_EQUAL_STRING("my/own.yaml", site->scenario);
}

static void test_settings_are_put_over_the_file(void)
{
    with_line(0, NULL);
    parse("f.yaml", "robots.1.link=tcp:127.0.0.1:4000");
    TEST_ASSERT_NOT_NULL_MESSAGE(site, error);
    TEST_ASSERT_EQUAL_INT(LINK_TCP, site->robots[1].link.address.kind);
    parse("f.yaml", "mocap.server=10.0.0.6");
    TEST_ASSERT_EQUAL_STRING("10.0.0.6", site->mocap.server);
    parse("f.yaml", "patience=-1");
    TEST_ASSERT_NULL(site);
    TEST_ASSERT_EQUAL_STRING("<--set patience=-1>:1:10: error: patience is -1; a number from 0 to "
                             "3600 s is allowed",
                             error);
}

static void test_what_is_missing_is_named(void)
{
    refuse(NAME, "", "f.yaml:1:1: error: the key 'name' is missing; schema, name, scenario, mocap");
    refuse(MOCAP, "", "f.yaml:1:1: error: the key 'mocap' is missing");
    refuse(MOCAP, "mocap: {server: h}",
           "f.yaml:3:8: error: the key 'protocol' is missing; protocol, server");
    refuse(MOCAP, "mocap: {protocol: natnet}",
           "f.yaml:3:8: error: natnet has no server; the server's address, or the version of one "
           "that is only listened to, is allowed");
    refuse(MOCAP, "mocap: {protocol: vrpn}",
           "f.yaml:3:8: error: the key 'server' is missing; vrpn needs it");
    refuse(MOCAP, "mocap: {protocol: qtm}",
           "f.yaml:3:8: error: the key 'server' is missing; qtm needs it");
    refuse(MOCAP, "mocap: {protocol: poses}",
           "f.yaml:3:8: error: the key 'file' is missing; poses needs it");
    refuse(ROBOT, "  - {id: 7}", "f.yaml:6:5: error: the key 'link' is missing");
    refuse(ROBOT, "  - {link: \"tty:/dev/ttyUSB0\"}", "f.yaml:6:5: error: the key 'id' is missing");
}

static void test_unknown_keys_are_refused(void)
{
    refuse(LAST, "patiense: 10", "f.yaml:7:1: error: unknown key 'patiense', perhaps 'patience'; ");
    refuse(LAST, "name: again", "f.yaml:7:1: error: ");
    refuse(MOCAP, "mocap: {protocol: natnet, sever: h}",
           "f.yaml:3:27: error: unknown key 'sever', perhaps 'server'; ");
    refuse(ROBOT, "  - {id: 7, link: \"tty:/dev/ttyUSB0\", adaptor: hci0}",
           "f.yaml:6:39: error: unknown key 'adaptor', perhaps 'adapter'; ");
    refuse(LAST, "network: {ranges: 1}", "f.yaml:7:11: error: unknown key 'ranges'");
    refuse(LAST, "wheels: {tracks: 1}", "f.yaml:7:10: error: unknown key 'tracks'");
}

static void test_each_protocol_has_its_own_keys(void)
{
    refuse(MOCAP, "mocap: {protocol: vrpn, server: h, group: 239.255.42.99}",
           "f.yaml:3:36: error: vrpn has no 'group'; protocol, up, scale, jump, latency, server, "
           "port are allowed");
    refuse(MOCAP, "mocap: {protocol: vicon, server: h}",
           "f.yaml:3:26: error: vicon has no 'server'");
    refuse(MOCAP, "mocap: {protocol: dtrack, interface: h}",
           "f.yaml:3:27: error: dtrack has no 'interface'");
    refuse(MOCAP, "mocap: {protocol: natnet, server: h, file: p.csv}",
           "f.yaml:3:38: error: natnet has no 'file'");
    refuse(MOCAP, "mocap: {protocol: qtm, server: h, repeat: true}",
           "f.yaml:3:35: error: qtm has no 'repeat'");
    refuse(MOCAP, "mocap: {protocol: poses, file: p.csv, port: 1}",
           "f.yaml:3:39: error: poses has no 'port'; protocol, up, scale, jump, latency, file, "
           "repeat are allowed");
}

static void test_motion_capture_is_judged(void)
{
    refuse(MOCAP, "mocap: optitrack", "f.yaml:3:8: error: mocap is a single value; a mapping");
    refuse(
        MOCAP, "mocap: {protocol: optitrack}",
        "f.yaml:3:19: error: protocol is 'optitrack'; allowed: natnet, vrpn, vicon, qtm, dtrack, "
        "poses");
    refuse(MOCAP, "mocap: {protocol: vicon, port: 0}",
           "f.yaml:3:32: error: port is 0; a whole number from 1 to 65535 is allowed");
    refuse(MOCAP, "mocap: {protocol: vicon, port: 65536}", "f.yaml:3:32: error: port is 65536; ");
    refuse(MOCAP, "mocap: {protocol: vicon, up: x}",
           "f.yaml:3:30: error: up is 'x'; allowed: z, y");
    refuse(MOCAP, "mocap: {protocol: vicon, scale: 0}", "f.yaml:3:33: error: scale is 0; ");
    refuse(MOCAP, "mocap: {protocol: vicon, scale: 1001}", "f.yaml:3:33: error: scale is 1001; ");
    refuse(MOCAP, "mocap: {protocol: vicon, jump: -0.1}", "f.yaml:3:32: error: jump is -0.1; ");
    refuse(MOCAP, "mocap: {protocol: vicon, latency: 5}",
           "f.yaml:3:35: error: latency is 5; a number from 0 to 1 s is allowed");
    refuse(MOCAP, "mocap: {protocol: vrpn, server: \"\"}",
           "f.yaml:3:33: error: server has 0 bytes; 1 to 1000 are allowed");
}

static void test_what_of_natnet_does_not_go_together(void)
{
    refuse(MOCAP, "mocap: {protocol: natnet, server: h, group: 239.0.0.1, unicast: true}",
           "f.yaml:3:45: error: a group and unicast; either of them is allowed");
    refuse(MOCAP, "mocap: {protocol: natnet, server: h, group: 192.168.1.1}",
           "f.yaml:3:45: error: group is '192.168.1.1'; an IPv4 multicast address, 224.0.0.0 to "
           "239.255.255.255, is allowed");
    refuse(MOCAP, "mocap: {protocol: natnet, server: h, group: all}",
           "f.yaml:3:45: error: group is 'all'; ");
}

static void test_versions_of_natnet(void)
{
    static const char *const refused[] = {"2.4", "4.3", "3",    "3.",   ".0",    "3.0.0",
                                          "v3",  "3.x", "13.0", "3.-1", "2.100", "\"\""};
    static const char *const accepted[] = {"2.5", "2.10", "3.1", "4.2"};
    char line[100];

    for (size_t i = 0; i < sizeof refused / sizeof refused[0]; i++) {
        snprintf(line, sizeof line, "mocap: {protocol: natnet, version: %s}", refused[i]);
        refuse(MOCAP, line, "f.yaml:3:36: error: version is '");
        TEST_ASSERT_NOT_NULL(strstr(error, "'; 2.5 to 4.2 are allowed"));
    }
    for (size_t i = 0; i < sizeof accepted / sizeof accepted[0]; i++) {
        snprintf(line, sizeof line, "mocap: {protocol: natnet, version: %s}", accepted[i]);
        accept(MOCAP, line);
    }
}

static void test_robots_are_judged(void)
{
    refuse(ROBOT, "  - 7", "f.yaml:6:5: error: the value is a single value; a mapping");
    refuse(ROBOT, "  - {id: 0, link: \"tty:/dev/ttyUSB0\"}",
           "f.yaml:6:10: error: id is 0; a whole number from 1 to 65534 is allowed");
    refuse(ROBOT, "  - {id: 7, link: \"serial:/dev/ttyUSB0\"}",
           "f.yaml:6:19: error: link is 'serial:/dev/ttyUSB0'; ");
    TEST_ASSERT_NOT_NULL(strstr(error, "rfcomm:"));
    refuse(ROBOT, "  - {id: 7, link: [tty]}", "f.yaml:6:19: error: link is a list");
    refuse(ROBOT, "  - {id: 7, link: \"tty:/dev/ttyUSB0\", adapter: hci0}",
           "f.yaml:6:48: error: an adapter for a link that is not rfcomm:");
    refuse(ROBOT, "  - {id: 7, link: \"rfcomm:00:14:03:05:59:03\", adapter: hci16}",
           "f.yaml:6:56: error: adapter is 'hci16'; hci0 to hci15 are allowed");
    refuse(ROBOT, "  - {id: 7, link: \"tty:/dev/ttyUSB0\", heading: 90}",
           "f.yaml:6:48: error: heading is 90; ");
    refuse(ROBOT, "  - {id: 7, link: \"tty:/dev/ttyUSB0\", baud: 300}",
           "f.yaml:6:45: error: baud is 300; a whole number from 1200 to 1000000 is allowed");
    refuse(ROBOT, "  - {id: 7, link: \"tty:/dev/ttyUSB0\", body_id: -1}",
           "f.yaml:6:48: error: body_id is -1; ");
    refuse(ROBOT,
           "  - {id: 7, link: \"tty:/dev/ttyUSB0\", body: "
           "a123456789b123456789c123456789d123456789e123456789f123456789g123}",
           "f.yaml:6:45: error: body has 64 bytes; 1 to 63 are allowed");
}

static void test_two_robots_share_nothing(void)
{
    refuse(ROBOT, "  - {id: 1, body: Cart, link: \"tty:/dev/ttyUSB0\"}",
           "f.yaml:6:10: error: robots 'Robot1' and 'Cart' have the same id 1; each has its own");
    refuse(ROBOT, "  - {id: 7, link: \"rfcomm:00:14:03:05:59:02/2\"}",
           "f.yaml:6:19: error: robots 1 and 7 have the same link; each has its own");
    refuse(ROBOT, "  - {id: 7, link: \"tty:/dev/ttyUSB0\", body: Robot1}",
           "f.yaml:6:45: error: robots 1 and 7 have the same body 'Robot1'; each has its own");
    refuse(FIRST_ROBOT, "  - {id: 1, link: \"tty:/dev/ttyUSB1\", body: Robot7}",
           "f.yaml:6:5: error: robots 1 and 7 have the same body 'Robot7'; each has its own");
    refuse(LAST,
           "  - {id: 3, link: \"tcp:h:4000\", body_id: 4}\n"
           "  - {id: 4, link: \"tcp:h:4001\", body_id: 4}",
           "f.yaml:8:42: error: robots 3 and 4 have the same body_id 4; each has its own");
    accept(LAST, "  - {id: 3, link: \"tcp:h:4000\"}\n  - {id: 4, link: \"tcp:h:4001\"}");
}

#define VRPN_SITE                                                                                  \
    "schema: 1\nname: n\nmocap: {protocol: vrpn, server: h}\nrobots:\n"                            \
    "  - {id: 1, link: \"tcp:h:1\", body: Wagon, body_id: 0}\n"

static bool is_good(const char *file)
{
    char error[512] = "";
    struct site *site = site_parse("f.yaml", file, strlen(file), NULL, 0, error, sizeof error);
    bool good = site != NULL;

    site_free(site);
    return good;
}

static void test_sensors_of_a_tracker(void)
{
    TEST_ASSERT_TRUE(
        is_good(VRPN_SITE "  - {id: 2, link: \"tcp:h:2\", body: Wagon, body_id: 1}\n"));
    TEST_ASSERT_TRUE(is_good(VRPN_SITE "  - {id: 2, link: \"tcp:h:2\", body: Cart, body_id: 0}\n"));
    TEST_ASSERT_FALSE(
        is_good(VRPN_SITE "  - {id: 2, link: \"tcp:h:2\", body: Wagon, body_id: 0}\n"));
    TEST_ASSERT_FALSE(is_good(VRPN_SITE "  - {id: 2, link: \"tcp:h:2\", body: Wagon}\n"));
}

/* A file with nothing but that many robots. */
static void parse_robots(int count)
{
    size_t length =
        (size_t)sprintf(text, "schema: 1\nname: n\nmocap: {protocol: vicon}\nrobots:\n");

    if (count == 0)
        sprintf(text + length, "  []\n");
    for (int id = 1; id <= count; id++)
        length += (size_t)sprintf(text + length, "  - {id: %d, link: \"tcp:h:%d\"}\n", id, id);
    parse("f.yaml", NULL);
}

static void test_the_number_of_robots(void)
{
    parse_robots(CAPTURE_BODIES_MAX);
    TEST_ASSERT_NOT_NULL_MESSAGE(site, error);
    TEST_ASSERT_EQUAL_UINT(CAPTURE_BODIES_MAX, site->robot_count);
    parse_robots(CAPTURE_BODIES_MAX + 1);
    TEST_ASSERT_NULL(site);
    TEST_ASSERT_EQUAL_STRING("f.yaml:5:3: error: 513 robots; 1 to 512 are allowed", error);
    parse_robots(0);
    TEST_ASSERT_NULL(site);
    TEST_ASSERT_EQUAL_STRING("f.yaml:5:3: error: 0 robots; 1 to 512 are allowed", error);
}

static void test_the_arena_is_judged(void)
{
    refuse(LAST, "fence: 2", "f.yaml:7:8: error: fence is a single value; a list");
    refuse(LAST, "fence: [1, 2]",
           "f.yaml:7:8: error: fence holds 2 numbers; [x_min, y_min, x_max, y_max] is allowed");
    refuse(LAST, "fence: [2, -2, -2, 2]",
           "f.yaml:7:8: error: the fence encloses nothing; x_min below x_max and y_min below y_max "
           "are allowed");
    refuse(LAST, "fence: [-2, 2, 2, 2]", "f.yaml:7:8: error: the fence encloses nothing");
    refuse(LAST, "fence: [-2, -2, 2, 3000]", "f.yaml:7:20: error: the value is 3000; ");
    refuse(LAST, "latency: 0.3", "f.yaml:7:10: error: latency is 0.3; a number from 0 to 0.255 s");
    refuse(LAST, "separation: -1", "f.yaml:7:13: error: separation is -1; ");
    refuse(LAST, "battery: 6600", "f.yaml:7:10: error: battery is 6600; ");
    refuse(LAST, "network: {loss: 2}", "f.yaml:7:17: error: loss is 2; ");
    refuse(LAST, "wheels: {track: 0, max: 1}", "f.yaml:7:17: error: track is 0; ");
    refuse(LAST, "wheels: {max: 7}", "f.yaml:7:15: error: max is 7; ");
    refuse(NAME, "name: my/lab", "f.yaml:2:7: error: name is 'my/lab'; ");
    refuse(1, "schema: 2", "f.yaml:1:9: error: schema is 2; 1 is allowed");
}

static void test_a_file_that_is_not_there(void)
{
    TEST_ASSERT_NULL(site_read("/nowhere/site.yaml", NULL, 0, error, sizeof error));
    TEST_ASSERT_EQUAL_STRING("/nowhere/site.yaml:1:1: error: cannot be opened: No such file or "
                             "directory",
                             error);
}

/* The documentation's example, with the scenario that it names. */
static void test_the_example_is_right(void)
{
    site = site_read(MUSTER_EXAMPLES "/site.yaml", NULL, 0, error, sizeof error);
    TEST_ASSERT_NOT_NULL_MESSAGE(site, error);
    TEST_ASSERT_EQUAL_STRING("lab", site->name);
    TEST_ASSERT_EQUAL_UINT(4, site->robot_count);
    struct scenario *scenario = scenario_read(site->scenario, NULL, 0, 128, error, sizeof error);
    TEST_ASSERT_NOT_NULL_MESSAGE(scenario, error);
    TEST_ASSERT_EQUAL_UINT(4, scenario->robot_count);
    for (size_t i = 0; i < 4; i++)
        TEST_ASSERT_EQUAL_UINT(scenario->robots[i].id, site->robots[i].id);
    scenario_free(scenario);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_a_file_leaves_out);
    RUN_TEST(test_what_a_robot_leaves_out);
    RUN_TEST(test_what_a_robot_may_have);
    RUN_TEST(test_a_body_that_has_a_number_needs_no_name);
    RUN_TEST(test_what_the_arena_may_have);
    RUN_TEST(test_every_protocol_has_a_name);
    RUN_TEST(test_what_natnet_may_have);
    RUN_TEST(test_paths_begin_at_the_files_folder);
    RUN_TEST(test_settings_are_put_over_the_file);
    RUN_TEST(test_what_is_missing_is_named);
    RUN_TEST(test_unknown_keys_are_refused);
    RUN_TEST(test_each_protocol_has_its_own_keys);
    RUN_TEST(test_motion_capture_is_judged);
    RUN_TEST(test_what_of_natnet_does_not_go_together);
    RUN_TEST(test_versions_of_natnet);
    RUN_TEST(test_robots_are_judged);
    RUN_TEST(test_two_robots_share_nothing);
    RUN_TEST(test_sensors_of_a_tracker);
    RUN_TEST(test_the_number_of_robots);
    RUN_TEST(test_the_arena_is_judged);
    RUN_TEST(test_a_file_that_is_not_there);
    RUN_TEST(test_the_example_is_right);
    return UNITY_END();
}
