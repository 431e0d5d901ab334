"""topics.py FILE: the messages in FILE (topics.c) mean to rosbags and to mcap-ros2-support what went
into them, and what one topic says the others do."""

import dataclasses
import json
import math
import sys

from mcap.records import Schema
from mcap_ros2.decoder import DecoderFactory
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

ADD, DELETE, DELETEALL = 0, 2, 3


def values_of(message):
    """All that is in a message of either package, in the order of its fields."""
    if isinstance(message, (str, bool, int, float)):
        return [message]
    if dataclasses.is_dataclass(message):
        names = [field.name for field in dataclasses.fields(message)]  # constants are in capitals
        fields = [getattr(message, name) for name in names if name.islower() and name[0] != "_"]
    elif hasattr(message, "__slots__"):
        fields = [getattr(message, name) for name in message.__slots__]
    else:
        fields = message.tolist() if hasattr(message, "tolist") else message
    return [value for field in fields for value in values_of(field)]


class Readers:
    def __init__(self):
        self.factory = DecoderFactory()
        self.count = 0

    def read(self, kind, definition, data):
        store = get_typestore(Stores.EMPTY)
        store.register(get_types_from_msg(definition, kind))
        message = store.deserialize_cdr(data, kind)
        assert bytes(store.serialize_cdr(message, kind)) == data, f"{kind}: rosbags writes it otherwise"
        self.count += 1
        schema = Schema(id=self.count, data=definition.encode(), encoding="ros2msg", name=kind)
        other = self.factory.decoder_for("cdr", schema)(data)
        assert values_of(other) == values_of(message), f"{kind}: the packages read it differently"
        return message


def same_place(pose, at, robot):
    yaw = 2 * math.atan2(at.z, at.w)
    assert (pose.x, pose.y, pose.z) == (robot.x, robot.y, 0), robot.id
    assert math.isclose(math.remainder(yaw - robot.theta, 2 * math.pi), 0, abs_tol=1e-12), robot.id
    assert at.x == at.y == 0 and math.isclose(at.z**2 + at.w**2, 1)


def check_stamp(header, fleet):
    assert (header.stamp.sec, header.stamp.nanosec) == (fleet.stamp.sec, fleet.stamp.nanosec)
    assert header.frame_id == "map"


def check_transforms(message, fleet):
    frames = {t.child_frame_id: t.transform for t in message.transforms}
    assert len(frames) == len(message.transforms) == len(fleet.robots) + 1
    for transform in message.transforms:
        check_stamp(transform.header, fleet)
    for robot in fleet.robots:
        transform = frames[f"robot_{robot.id}"]
        same_place(transform.translation, transform.rotation, robot)
    reference = frames["reference"].translation
    assert (reference.x, reference.y) == (fleet.reference_x, fleet.reference_y)


def check_poses(message, fleet):
    check_stamp(message.header, fleet)
    assert len(message.poses) == len(fleet.robots)
    for pose, robot in zip(message.poses, fleet.robots):
        same_place(pose.position, pose.orientation, robot)


def color(marker):
    return tuple(round(value * 255) for value in (marker.color.r, marker.color.g, marker.color.b))


def check_markers(message, fleet):
    assert message.markers[0].action == DELETEALL and message.markers[0].ns == "vertices"
    markers = {(m.ns, m.id): m for m in message.markers[1:]}
    assert len(markers) == len(message.markers) - 1
    for marker in message.markers:
        check_stamp(marker.header, fleet)
    for robot in fleet.robots:
        body = markers.pop(("bodies", robot.id))
        same_place(body.pose.position, body.pose.orientation, robot)
        expected = ((153, 153, 153) if not robot.alive else
                    {0: (0, 158, 115), 1: (230, 159, 0), 2: (0, 114, 178)}[robot.role])
        assert color(body) == expected, robot.id
        assert len(body.points) % 3 == 0 and body.type == body.TRIANGLE_LIST
        assert markers.pop(("ids", robot.id)).text == str(robot.id)
        circle = markers.pop(("range", robot.id))
        assert circle.action == (ADD if robot.alive and robot.role == 2 else DELETE), robot.id
        for point in circle.points:
            assert math.isclose(math.hypot(point.x, point.y), fleet.range)
    for number, vertex in enumerate(fleet.vertices, 1):
        place = markers.pop(("vertices", number)).pose.position
        assert (place.x, place.y) == (vertex.x, vertex.y)
    assert not markers


def pairs_of(fleet):
    """Who is linked: leaders reach all, candidates one another, others within the range."""
    live = [r for r in fleet.robots if r.alive and r.linked and not r.muted]
    for i, one in enumerate(live):
        for other in live[i + 1:]:
            near = math.hypot(one.x - other.x, one.y - other.y) <= fleet.range
            leads = 1 in (one.role, other.role)
            far = all(r.candidate or r.role == 0 for r in (one, other))
            if one.group == other.group and (leads or near or far):
                yield leads, frozenset([(one.x, one.y), (other.x, other.y)])


def check_links(message, fleet):
    check_stamp(message.header, fleet)
    ends = [(p.x, p.y) for p in message.points]
    lines = [frozenset(pair) for pair in zip(ends[::2], ends[1::2])]
    leads = [round(c.r * 255) == 230 for c in message.colors]
    assert leads[::2] == leads[1::2] and len(message.colors) == len(ends)
    assert sorted(map(repr, zip(leads[::2], lines))) == sorted(map(repr, pairs_of(fleet)))
    assert message.action == (ADD if lines else DELETE)


CHECKS = {
    "/tf": check_transforms,
    "/muster/poses": check_poses,
    "/muster/markers": check_markers,
    "/muster/links": check_links,
    "/muster/mean_distance_error": lambda m, fleet: values_of(m) == [fleet.mean_distance_error],
    "/muster/leader": lambda m, fleet: values_of(m) == [fleet.leader],
}


def main():
    readers, seen, fleet = Readers(), [], None
    with open(sys.argv[1], encoding="utf-8") as lines:
        for line in lines:
            topic, kind, definition, data, values = line.rstrip("\n").split("\t")
            message = readers.read(kind, bytes.fromhex(definition).decode(), bytes.fromhex(data))
            seen.append(topic)
            if values:
                assert values_of(message) == json.loads(values), topic
            if topic == "/muster/fleet":
                fleet = message
            elif topic in CHECKS:
                assert CHECKS[topic](message, fleet) in (None, True), topic
    assert len(set(seen)) == 8 and len(seen) == 15, seen
    print(f"{len(seen)} messages on {len(set(seen))} topics")


main()
