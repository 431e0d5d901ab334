"""What natnet_poses wrote, against what the package natnet from PyPI reads in the same datagrams."""
import sys

from natnet import DataDescriptions, DataFrame
from natnet.packet_buffer import PacketBuffer
from natnet.version import Version

NEAR = 1e-6


def read(kind, major, minor, text):
    buffer = PacketBuffer(bytes.fromhex(text))
    buffer.pointer = 4
    return kind.read_from_buffer(buffer, Version(int(major), int(minor)))


def theirs(models, frame, version):
    names = {body.id_num: body.name for body in models.rigid_bodies}
    for body in frame.rigid_bodies:
        valid = body.tracking_valid if version >= (2, 6) else True
        yield body.id_num, names[body.id_num], valid, (*body.pos, *body.rot)


def same(ours, other):
    return ours[:3] == other[:3] and all(abs(a - b) < NEAR for a, b in zip(ours[3], other[3]))


compared = wrong = 0
expected = iter(())
for line in open(sys.argv[1]):
    kind, *fields = line.rstrip("\n").split("\t")
    if kind == "models":
        models = read(DataDescriptions, *fields)
    elif kind == "frame":
        version = (int(fields[0]), int(fields[1]))
        expected = theirs(models, read(DataFrame, *fields), version)
    else:
        ours = int(fields[0]), fields[1], fields[2] == "1", tuple(map(float, fields[3:]))
        other = next(expected, (None,) * 4)
        compared += 1
        if other[0] is None or not same(ours, other):
            wrong += 1
            print(f"NatNet {version[0]}.{version[1]}: {ours}, but natnet reads {other}")
print(f"{compared} poses compared, {wrong} differ")
sys.exit(compared != 12 * 3 or wrong != 0)
