"""qtm_session.py STREAM POSES: what qtm_rt, Qualisys' own package, reads from the stream is what our
decoder has made of it."""

import csv
import math
import sys
import xml.etree.ElementTree

from qtm_rt.packet import QRTPacketType
from qtm_rt.receiver import Receiver


def read_stream(path):
    """Names, and for each frame its time and bodies as qtm_rt has them."""
    names, frames = [], []

    def on_xml(text):
        root = xml.etree.ElementTree.fromstring(text)
        names[:] = [body.findtext("Name") for body in root.findall("The_6D/Body")]

    def on_data(packet):
        frames.append((packet.timestamp, packet.get_6d()[1]))

    receiver = Receiver({
        QRTPacketType.PacketCommand: lambda text: None,
        QRTPacketType.PacketXML: on_xml,
        QRTPacketType.PacketData: on_data,
    })
    with open(path, "rb") as stream:
        receiver.data_received(stream.read())
    return names, frames


def columns_of(x, y, z, w):
    return (
        1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w),
        2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w),
        2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y),
    )


def judge(row, name, time_us, place, matrix):
    """The largest difference in m or in an element of the matrix; None for a body that is lost."""
    assert row["body"] == name, (row, name)
    assert round(float(row["t"]) * 1e6) == time_us, (row, time_us)
    lost = math.isnan(place[0])
    assert row["tracked"] == ("0" if lost else "1"), row
    if lost:
        return None
    ours = [float(row[key]) for key in ("x", "y", "z")]
    ours += columns_of(*(float(row[key]) for key in ("qx", "qy", "qz", "qw")))
    theirs = [value / 1000 for value in place] + list(matrix)
    return max(abs(a - b) for a, b in zip(ours, theirs))


def main(stream, poses):
    names, frames = read_stream(stream)
    with open(poses, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    theirs = [(name, time_us, *body) for time_us, bodies in frames
              for name, body in zip(names, bodies)]
    assert len(rows) == len(theirs) > 0, (len(rows), len(theirs))
    judged = [judge(row, name, time_us, place, matrix.matrix)
              for row, (name, time_us, place, matrix) in zip(rows, theirs)]
    found = [difference for difference in judged if difference is not None]
    assert max(found) < 1e-6, max(found)
    print(f"{len(frames)} frames, {len(found)} poses, {len(judged) - len(found)} lost: "
          f"largest difference {max(found):.1e}")


main(*sys.argv[1:])
