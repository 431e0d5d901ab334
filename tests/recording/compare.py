"""compare.py RUN [cut]: what PyPI's mcap, with mcap-ros2-support, and rosbags read on every topic of
RUN/run.mcap are the values of RUN/trace.csv and RUN/events.csv. With `cut` the recording may end
before them."""

import csv
import math
import pathlib
import sys

from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory
from rosbags.highlevel import AnyReader

NEAR = 1e-6  # what the CSV files have been rounded to
ROLES = "CLF"
TICK_MS = 20


def with_mcap(path):
    with path.open("rb") as file:
        reader = make_reader(file, validate_crcs=True, decoder_factories=[DecoderFactory()])
        for _, channel, record, message in reader.iter_decoded_messages():
            yield channel.topic, record.log_time, message


def with_rosbags(path):
    with AnyReader([path]) as reader:
        for connection, time, raw in reader.messages():
            yield connection.topic, time, reader.deserialize(raw, connection.msgtype)


def ticks_of(run):
    """The rows of the trace by time in ms."""
    ticks = {}
    for row in csv.DictReader((run / "trace.csv").open()):
        for key in ("x", "y", "theta", "v", "omega", "distance_error"):
            row[key] = float(row[key])
        ticks.setdefault(round(float(row["t"]) * 1000), []).append(row)
    return ticks


def near(a, b):
    return abs(a - b) <= NEAR


def same_place(row, position):
    return near(row["x"], position.x) and near(row["y"], position.y)


def same_pose(row, position, turn):
    """The turn, as a quaternion about z, is that by theta."""
    heading = 2 * math.atan2(turn.z, turn.w) - row["theta"]
    return same_place(row, position) and near(math.remainder(heading, 2 * math.pi), 0)


def check_fleet(rows, message):
    assert len(message.robots) == len(rows)
    for row, robot in zip(rows, message.robots):
        assert robot.id == int(row["robot"]) and robot.vertex == int(row["vertex"])
        assert ROLES[robot.role] == row["role"] and robot.alive == (row["alive"] == "1")
        for key in ("x", "y", "theta", "v", "omega", "distance_error"):
            assert near(getattr(robot, key), row[key]), key


def check_transforms(rows, message):
    transforms = {one.child_frame_id: one.transform for one in message.transforms}
    assert set(transforms) == {"reference"} | {"robot_" + row["robot"] for row in rows}
    for row in rows:
        one = transforms["robot_" + row["robot"]]
        assert same_pose(row, one.translation, one.rotation)


def check_poses(rows, message):
    assert len(message.poses) == len(rows)
    for row, pose in zip(rows, message.poses):
        assert same_pose(row, pose.position, pose.orientation)


def check_markers(rows, message):
    bodies = {one.id: one.pose for one in message.markers if one.ns == "bodies"}
    ids = {one.id: one for one in message.markers if one.ns == "ids"}
    assert set(bodies) == set(ids) == {int(row["robot"]) for row in rows}
    for row in rows:
        robot = int(row["robot"])
        assert same_pose(row, bodies[robot].position, bodies[robot].orientation)
        assert same_place(row, ids[robot].pose.position) and ids[robot].text == row["robot"]


def check_links(rows, message):
    """Lines join robots that are alive."""
    alive = [row for row in rows if row["alive"] == "1"]
    assert len(message.points) % 2 == 0
    for point in message.points:
        assert any(same_place(row, point) for row in alive)


def check_mean_error(rows, message):
    errors = [row["distance_error"] for row in rows if row["alive"] == "1"]
    assert near(message.data, sum(errors) / len(errors))


def leaders(rows):
    return {int(row["robot"]) for row in rows if row["role"] == "L" and row["alive"] == "1"}


def check_leader(rows, message, before):
    """One that dies in this very tick is the leader still."""
    now = leaders(rows)
    assert message.data in now | leaders(before) or (message.data == 0 and not now)


CHECKS = {
    "/muster/fleet": check_fleet,
    "/tf": check_transforms,
    "/muster/poses": check_poses,
    "/muster/markers": check_markers,
    "/muster/links": check_links,
    "/muster/mean_distance_error": check_mean_error,
}


def stamp_ms(stamp):
    return round(stamp.sec * 1000 + stamp.nanosec / 1e6)


def stamp_of(message):
    if hasattr(message, "transforms"):
        return message.transforms[0].header.stamp
    if hasattr(message, "markers"):
        return next(one for one in message.markers if one.ns == "bodies").header.stamp
    return message.header.stamp if hasattr(message, "header") else getattr(message, "stamp", None)


def check_event(row, time_ms, message):
    at_ms = round(float(row["t"]) * 1000)
    assert stamp_ms(message.stamp) == at_ms and time_ms == max(0, at_ms)
    assert message.line == int(row["robot"]) and message.function == row["event"]
    assert message.file.replace(",", ";") == row["detail"]
    assert message.name == ("robot_" + row["robot"] if row["robot"] != "0" else "fleet")
    assert message.msg == " ".join(filter(None, (row["event"], message.file)))


def check_times(topic, times, ticks, cut):
    """At the same distance from the first tick to the last."""
    ends = max(ticks)
    assert times[0] == 0 and len(times) > 1, topic
    period = times[1]
    assert period % TICK_MS == 0 and times == list(range(0, times[-1] + 1, period)), topic
    assert cut or times[-1] + period > ends, topic


def check(run, name, messages, cut):
    ticks = ticks_of(run)
    events = list(csv.DictReader((run / "events.csv").open()))
    times = {topic: [] for topic in [*CHECKS, "/muster/leader"]}
    events_read = 0
    for topic, time_ns, message in messages:
        time_ms = time_ns // 1000000
        if topic == "/muster/events":
            check_event(events[events_read], time_ms, message)
            events_read += 1
            continue
        if topic == "/muster/leader":
            check_leader(ticks[time_ms], message, ticks.get(time_ms - TICK_MS, []))
        else:
            CHECKS[topic](ticks[time_ms], message)
        stamp = stamp_of(message)
        assert stamp is None or stamp_ms(stamp) == time_ms
        times[topic].append(time_ms)
    for topic in times:
        check_times(topic, times[topic], ticks, cut)
    assert times["/muster/fleet"] == sorted(ticks)[: len(times["/muster/fleet"])]
    assert cut or events_read == len(events)
    last = max(times["/muster/fleet"])
    assert not cut or 0 < last < max(ticks)
    missing = [e for e in events[events_read:] if round(float(e["t"]) * 1000) <= last]
    assert not missing, missing
    print(f"{name}: {sum(map(len, times.values()))} messages and {events_read} events are the same")


run = pathlib.Path(sys.argv[1])
cut = len(sys.argv) > 2
check(run, "mcap", with_mcap(run / "run.mcap"), cut)
check(run, "rosbags", with_rosbags(run / "run.mcap"), cut)
