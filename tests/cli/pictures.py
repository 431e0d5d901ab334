"""pictures.py report HTML SUMMARY | film SVG TRACE | svg FILE: whether a picture is what it should be."""

import csv
import html.parser
import json
import re
import sys
import xml.etree.ElementTree

SVG = "{http://www.w3.org/2000/svg}"
PLAY, TOTAL = 15.0, 16.5  # s of the leader fault's 30, and with the pause
OFF = 1.0  # pixels that a robot may be away from where the trace has it


def need(condition, words):
    if not condition:
        sys.exit(f"FAIL: {words}")


class Page(html.parser.HTMLParser):
    """Every tag is closed where it should be; nothing is outside; a table's rows are kept."""

    def __init__(self):
        super().__init__()
        self.open, self.ids, self.links, self.rows, self.tags = [], set(), [], [], set()

    def handle_starttag(self, tag, attributes):
        need(tag != "script", "a script")
        self.tags.add(tag)
        self.take(tag, dict(attributes))
        if tag not in ("!doctype",):
            self.open.append(tag)
        if tag == "tr":
            self.rows.append([])
        if tag in ("td", "th"):
            self.rows[-1].append("")

    def handle_startendtag(self, tag, attributes):
        self.take(tag, dict(attributes))

    def take(self, tag, attributes):
        need("src" not in attributes and "srcset" not in attributes, f"<{tag}> has a source")
        need(not any(name.startswith("on") for name in attributes), f"<{tag}> has a script")
        if "id" in attributes:
            need(attributes["id"] not in self.ids, f"two elements are {attributes['id']}")
            self.ids.add(attributes["id"])
        if "href" in attributes:
            self.links.append(attributes["href"])
        if tag == "svg":
            need(attributes.get("role") == "img" and attributes.get("aria-label"), "a figure without words")

    def handle_endtag(self, tag):
        need(self.open and self.open[-1] == tag, f"</{tag}> closes {self.open[-1:]}")
        self.open.pop()

    def handle_data(self, data):
        if self.open and self.open[-1] in ("td", "th"):
            self.rows[-1][-1] += data


def flat(node, path=""):
    for key, value in node.items():
        if isinstance(value, dict):
            yield from flat(value, f"{path}{key}.")
        else:
            yield path + key, value


def report(path, summary):
    text = open(path, encoding="utf-8").read()
    page = Page()
    page.feed(text)
    page.close()
    need(not page.open, f"{page.open} stay open")
    need("http:" not in text and "https:" not in text and "url(" not in text, "something is outside")
    for link in page.links:
        need(link[0] == "#" and link[1:] in page.ids, f"a link to {link}")
    need({"svg", "table", "h1"} <= page.tags, "no figure or no table")
    told = {row[1] for row in page.rows if len(row) == 2}
    for key, value in flat(json.load(open(summary, encoding="utf-8"))):
        if isinstance(value, bool):
            need(("yes" if value else "no") in told, f"{key} is not told")
        elif isinstance(value, (int, str)):
            need(str(value) in told, f"{key}, {value}, is not told")
        elif value is not None:
            need(any(number(words) is not None and abs(number(words) - value) <= 0.051 for words in told),
                 f"{key}, {value}, is not told")


def number(words):
    return float(words) if re.fullmatch(r"-?\d+(\.\d+)?", words) else None


def well_formed(path):
    text = open(path, encoding="utf-8").read()
    need("<script" not in text and "javascript" not in text, "a script")
    need(not re.search(r'href="[^#]', text) and "url(h" not in text and "@import" not in text, "something is outside")
    return xml.etree.ElementTree.fromstring(text)


def moving(root):
    """The animations, each with its times and values."""
    for element in root.iter():
        if not element.tag.startswith(SVG + "animate"):
            continue
        times = [float(t) for t in element.get("keyTimes").split(";")]
        values = element.get("values").split(";")
        need(element.get("dur") == f"{TOTAL:g}s" and element.get("repeatCount") == "indefinite", "another time")
        need(len(times) == len(values) > 1, "as many values as times")
        need(times[0] == 0 and times[-1] == 1 and times == sorted(times), "times rise from 0 to 1")
        yield element, times, values


def value_at(times, values, share):
    k = 0
    while k + 2 < len(times) and times[k + 1] <= share:
        k += 1
    part = (share - times[k]) / (times[k + 1] - times[k]) if times[k + 1] > times[k] else 0
    return [a + part * (b - a) for a, b in zip(values[k], values[k + 1])]


def line(xs, ys):
    """The straight line through points with the least squares: its rise and its height."""
    mx, my = sum(xs) / len(xs), sum(ys) / len(ys)
    rise = sum((x - mx) * (y - my) for x, y in zip(xs, ys)) / sum((x - mx) ** 2 for x in xs)
    return rise, my - rise * mx


def robots_of(root):
    """Of each robot: the track of its place, and that of its role."""
    film = next(g for g in root.iter(SVG + "g") if g.get("class") == "film")
    found = {}
    for g in film.iter(SVG + "g"):
        name = g.find(SVG + "text[@class='id']")
        if name is None:
            continue
        tracks = {}
        for element, times, values in moving(g):
            tracks.setdefault(element.get("type") or element.get("attributeName"), (times, values))
        found[int(name.text)] = tracks
    return found


def film(path, trace):
    root = well_formed(path)
    need(root.find(SVG + "title").text and "robot 1 is lost" in root.find(SVG + "desc").text, "no story")
    need(len(list(moving(root))) > 10, "nothing moves")
    robots = robots_of(root)
    rows = list(csv.DictReader(open(trace, encoding="utf-8")))
    need({int(row["robot"]) for row in rows} == set(robots), "other robots")
    seen = {"x": [], "y": []}
    for row in rows:
        times, values = robots[int(row["robot"])]["translate"]
        at = value_at(times, [[float(n) for n in v.split()] for v in values], float(row["t"]) / 30 * PLAY / TOTAL)
        for axis, pixels in zip("xy", at):
            seen[axis].append((float(row[axis]), pixels))
    for axis, sign in ("x", 1), ("y", -1):
        metres, pixels = zip(*seen[axis])
        rise, height = line(metres, pixels)
        need(rise * sign > 20, f"{rise} pixels a metre")
        off = max(abs(height + rise * m - p) for m, p in seen[axis])
        need(off < OFF, f"{axis} is {off:.2f} pixels off")
    states(robots)


def states(robots):
    def changes(robot):
        times, values = robots[robot]["class"]
        return [(round(t * TOTAL / PLAY * 30, 1), v) for t, v in zip(times, values)][:-1]

    need(changes(1) == [(0, "L"), (10.0, "X")], f"robot 1 is {changes(1)}")
    need(changes(2) == [(0, "F"), (10.4, "C"), (10.6, "L")], f"robot 2 is {changes(2)}")


if __name__ == "__main__":
    {"report": report, "film": film, "svg": well_formed}[sys.argv[1]](*sys.argv[2:])
