# SPDX-License-Identifier: BSD-3-Clause
"""The recordings of `waitpoint run --record` are valid in other programs: recordings_test.py BUILD.

MCAP files are read by a reader of this test, which checks every length, offset and checksum, and, if npm works, by the
format's reference reader.
"""

import functools
import json
import math
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import zlib

from mcap_records import (CHANNEL, CHUNK, CHUNK_INDEX, DATA_END, FOOTER, HEADER, MAGIC, MESSAGE, MESSAGE_INDEX, SCHEMA, STATISTICS,
                          SUMMARY_OFFSET, Fields, records)

BUILD = pathlib.Path(sys.argv.pop(1)).resolve()
ROOT = pathlib.Path(__file__).resolve().parents[2]


@functools.lru_cache(maxsize=None)
def folder():
    made = tempfile.TemporaryDirectory()
    unittest.addModuleCleanup(made.cleanup)
    return pathlib.Path(made.name)


def run(*options, scenario="office.yaml", until_s=12):
    return subprocess.run([BUILD / "tools/waitpoint", "run", ROOT / "scenarios" / scenario, "--until", str(until_s), *options],
                          capture_output=True, text=True)


@functools.lru_cache(maxsize=None)
def recorded(name):
    done = run("--record", folder() / name)
    assert "digest" in done.stdout, done.stderr
    return folder() / name


class Mcap(unittest.TestCase):
    def read(self, path):
        """{topic: [(time, message)]}, after checks of the consistency of the whole file."""
        data = path.read_bytes()
        self.assertTrue(data.startswith(MAGIC) and data.endswith(MAGIC))
        inner = data[:-len(MAGIC)]
        channels, topics, schemas, chunks, indexed, summary = {}, {}, {}, {}, {}, []
        section, footer = "data", None
        for at, operation, content in records(inner, len(MAGIC)):
            fields = Fields(content)
            if operation == CHUNK:
                first, last, size, checksum = (fields.number(n) for n in (8, 8, 8, 4))
                self.assertEqual(fields.text(), "")
                inside = fields.stream.read(fields.number(8))
                self.assertEqual((len(inside), zlib.crc32(inside)), (size, checksum))
                chunks[at] = (first, last, inside)
                for offset, what, message in records(inside):
                    of = Fields(message)
                    if what == SCHEMA:
                        number, name = of.number(2), of.text()
                        self.assertEqual(of.text(), "jsonschema")
                        schemas[number] = (name, json.loads(of.text()))
                    elif what == CHANNEL:
                        number, schema, topic = of.number(2), of.number(2), of.text()
                        self.assertEqual(of.text(), "json")
                        self.assertIn(schema, schemas)
                        channels[number] = topic
                        topics.setdefault(topic, [])
                    else:
                        self.assertEqual(what, MESSAGE)
                        channel, sequence, time, published = (of.number(n) for n in (2, 4, 8, 8))
                        self.assertEqual((sequence, published), (len(topics[channels[channel]]), time))
                        self.assertTrue(first <= time <= last)
                        topics[channels[channel]].append((time, json.loads(of.rest())))
                        indexed[at, channel, time, offset] = False
            elif operation == MESSAGE_INDEX:
                channel = fields.number(2)
                for time, offset in fields.map(8, 8):
                    self.assertFalse(indexed.pop((max(chunks), channel, time, offset)), "an index entry without its message")
            elif operation == DATA_END:
                self.assertEqual(fields.number(4), zlib.crc32(data[:at]))
                section, summary_start = "summary", at + 9 + len(content)
            elif operation == CHUNK_INDEX:
                first, last, offset, length = (fields.number(8) for _ in range(4))
                self.assertEqual((first, last), chunks[offset][:2])
                for channel, place in fields.map(2, 8):
                    self.assertEqual(inner[place], MESSAGE_INDEX)
            elif operation == STATISTICS:
                self.assertEqual(fields.number(8), sum(map(len, topics.values())))
                self.assertEqual((fields.number(2), fields.number(4)), (len(schemas), len(channels)))
                self.assertEqual([fields.number(4) for _ in range(3)], [0, 0, len(chunks)])
            elif operation == SUMMARY_OFFSET:
                group, start, length = fields.number(1), fields.number(8), fields.number(8)
                self.assertTrue(all(what == group for _, what, _ in records(inner[:start + length], start)))
            elif operation == FOOTER:
                footer = at
                self.assertEqual(fields.number(8), summary_start)
                self.assertEqual(inner[fields.number(8)], SUMMARY_OFFSET)
                self.assertEqual(fields.number(4), zlib.crc32(data[summary_start:at + 9 + 16]))
        self.assertFalse(indexed, "a message without its index entry")
        self.assertIsNotNone(footer)
        return topics

    def test_holds_the_scans_and_estimates_of_the_robot(self):
        topics = self.read(recorded("office.mcap"))
        scans = [scan for _, scan in topics["/rackham/laser"]]
        self.assertGreater(len(scans), 110)
        for scan in scans:
            self.assertEqual((len(scan["ranges"]), scan["frame_id"]), (361, "rackham/laser"))
            self.assertAlmostEqual(scan["end_angle"] - scan["start_angle"], math.pi)
        frames = {(frame["parent_frame_id"], frame["child_frame_id"]) for _, frame in topics["/tf"]}
        self.assertEqual(frames, {("world", "rackham"), ("world", "rackham/position"), ("rackham/position", "rackham/laser")})
        self.assertEqual([time for time, _ in topics["/clock"]][:3], [10_000_000, 110_000_000, 210_000_000])
        (_, world), = topics["/world"]
        self.assertGreater(len(world["entities"][0]["cubes"]), 50)
        truth, believed = (topics[f"/rackham/{name}"][-1][1]["pose"]["position"] for name in ("truth", "position"))
        self.assertLess(math.hypot(truth["x"] - believed["x"], truth["y"] - believed["y"]), 0.2)

    def test_holds_the_requests_to_modules_and_their_reports(self):
        lines = [(line["name"], line["message"], line["level"]) for _, line in self.read(recorded("office.mcap"))["/rackham/modules"]]
        for module, request in (("rflex", "TrackSpeedStart"), ("ndd", "GoTo")):
            told = [message for name, message, _ in lines if name == module and message.startswith(request + ":")]
            self.assertEqual(told[:2], [f"{request}: asked", f"{request}: activity {told[1].split()[2]} started"])
        self.assertIn(("pom", "SetPos: done", 2), lines)

    def test_is_read_by_the_reference_reader(self):
        if shutil.which("npm") is None:
            self.skipTest("there is no npm here")
        try:
            subprocess.run(["npm", "install", "--prefix", folder(), "@mcap/core@2"], capture_output=True, check=True, timeout=60)
        except (subprocess.CalledProcessError, subprocess.TimeoutExpired):
            self.skipTest("npm does not answer")
        program = folder() / "read.mjs"
        program.write_text("""
import { McapIndexedReader } from "@mcap/core";
import { readFile } from "node:fs/promises";
const data = new Uint8Array(await readFile(process.argv[2]));
const readable = {
  size: async () => BigInt(data.length),
  read: async (offset, size) => data.subarray(Number(offset), Number(offset + size)),
};
const reader = await McapIndexedReader.Initialize({ readable });
const counts = {};
for await (const message of reader.readMessages({ startTime: 5000000000n })) {
  const topic = reader.channelsById.get(message.channelId).topic;
  counts[topic] = (counts[topic] ?? 0) + 1;
}
console.log(JSON.stringify(counts));
""")
        read = subprocess.run(["node", program, recorded("office.mcap")], capture_output=True, text=True, check=True)
        own = self.read(recorded("office.mcap"))
        late = {topic: sum(time >= 5_000_000_000 for time, _ in messages) for topic, messages in own.items()}
        self.assertEqual(json.loads(read.stdout), {topic: count for topic, count in late.items() if count})


class RosBag(unittest.TestCase):
    def setUp(self):
        if "./dev add bags" in run("--record", folder() / "x.bag", until_s=0.1).stderr:
            self.skipTest("this waitpoint was built without rosbag_storage")

    def test_is_read_by_the_stock_rosbag(self):
        if shutil.which("rosbag") is None:
            self.skipTest("there is no rosbag here")
        told = subprocess.run(["rosbag", "info", recorded("office.bag")], capture_output=True, text=True, check=True).stdout
        counts = {topic: (int(count), kind) for topic, count, kind in re.findall(r"(/\S+) +(\d+) msgs? *: (\S+)", told)}
        self.assertEqual({topic: kind for topic, (_, kind) in counts.items()}, {
            "/clock": "rosgraph_msgs/Clock", "/tf": "tf2_msgs/TFMessage", "/world": "visualization_msgs/MarkerArray",
            "/rackham/laser": "sensor_msgs/LaserScan", "/rackham/odometry": "nav_msgs/Odometry",
            "/rackham/position": "geometry_msgs/PoseWithCovarianceStamped", "/rackham/truth": "geometry_msgs/PoseStamped",
            "/rackham/modules": "rosgraph_msgs/Log"})
        topics = Mcap.read(self, recorded("office.mcap"))
        for topic in ("/clock", "/rackham/laser", "/rackham/odometry", "/rackham/modules"):
            self.assertEqual(counts[topic][0], len(topics[topic]), topic)
        self.assertRegex(told, r"end: +Jan 01 1970 00:00:11\.99")

    def test_has_the_same_bytes_again_and_changes_no_digest(self):
        self.assertIn(re.search(r"wp1:\w+", run().stdout)[0], run("--record", folder() / "again.bag").stdout)
        self.assertEqual((folder() / "again.bag").read_bytes(), recorded("office.bag").read_bytes())

    def test_is_replayed_alike_when_the_stock_rosbag_has_compressed_it(self):
        try:
            import rosbag
        except ImportError:
            self.skipTest("there is no rosbag here")
        digests = set()
        for compression in (rosbag.Compression.NONE, rosbag.Compression.BZ2, rosbag.Compression.LZ4):
            copy = folder() / f"{compression}.bag"
            with rosbag.Bag(str(recorded("office.bag"))) as read, rosbag.Bag(str(copy), "w", compression=compression) as written:
                for topic, message, time in read.read_messages():
                    written.write(topic, message, time)
            replayed = subprocess.run([BUILD / "tools/waitpoint", "play", copy], capture_output=True, text=True)
            self.assertEqual(replayed.returncode, 0, replayed.stderr)
            digests.add(re.search(r"wp1:\w+", replayed.stdout)[0])
        self.assertEqual(len(digests), 1)


class Carmen(unittest.TestCase):
    def test_has_scans_and_odometry_in_its_words(self):
        lines = [line.split() for line in recorded("office.log").read_text().splitlines() if not line.startswith("#")]
        scans = [line for line in lines if line[0] == "FLASER"]
        self.assertGreater(len(scans), 110)
        for line in scans:
            count = int(line[1])
            self.assertEqual((count, len(line)), (361, 2 + count + 6 + 3))
            ranges, places = [list(map(float, part)) for part in (line[2:2 + count], line[2 + count:8 + count])]
            self.assertTrue(all(0 <= value <= 81.92 for value in ranges))
            self.assertLess(math.dist(places[:2], places[3:5]), 0.5)
        self.assertEqual({line[0] for line in lines}, {"FLASER", "ODOM", "TRUEPOS"})
        self.assertTrue(all(len(line) == 10 for line in lines if line[0] != "FLASER"))
        times = [float(line[-1]) for line in lines if line[0] == "ODOM"]
        self.assertEqual(times, sorted(times))


class Recording(unittest.TestCase):
    def test_changes_no_digest_and_repeats_to_the_byte(self):
        plain = re.search(r"wp1:\w+", run().stdout)[0]
        for name in ("again.mcap", "again.log"):
            self.assertIn(plain, run("--record", folder() / name).stdout)
            self.assertEqual((folder() / name).read_bytes(), recorded(name.replace("again", "office")).read_bytes())

    def test_ten_robots_have_a_topic_each(self):
        run("--record", folder() / "ten.mcap", scenario="office-10.yaml", until_s=2)
        topics = Mcap.read(self, folder() / "ten.mcap")
        self.assertEqual(sum(topic.endswith("/truth") for topic in topics), 10)

    def test_unwritable_file_is_reported_in_one_line(self):
        for name, words in (("x.pcap", "expected a file .mcap"), ("nowhere/x.mcap", "nowhere"), ("nowhere/x.bag", "nowhere"),
                            ("x", "expected a file .mcap")):
            done = run("--record", folder() / name)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
            self.assertIn(words, done.stderr)
            self.assertFalse((folder() / name).exists())
        for options in (["--seeds", "1..2"], ["--verify"]):
            self.assertEqual(run("--record", folder() / "x.mcap", *options).returncode, 2)


if __name__ == "__main__":
    unittest.main()
