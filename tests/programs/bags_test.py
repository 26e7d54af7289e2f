# SPDX-License-Identifier: BSD-3-Clause
"""Bags of ROS 1 in virtual time: bags_test.py BUILD [--replay-bags [N]].

`rosbag record` and `rosbag play` as nodes of a run, and `waitpoint run --play`. With --replay-bags: the map of a node with
four threads, N times (default: 100) under waitpoint, and ten times by roscore and `rosbag play` on the system's threads.
Skipped where ROS is missing.
"""

import hashlib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

from nodes_case import BUILD, NodesCase, ROOT, WAITPOINT

MAPPER = BUILD / "scenarios/nodes/mapper"
OFFICE_MAP = ROOT / "scenarios/office-map.yaml"

MAP = f"""
format: 1
name: map
play: {{topics: [/rackham/laser, /rackham/odometry], outputs: [map.pgm]}}
nodes:
  - {{name: mapper, command: [{MAPPER}], remap: {{scan: /rackham/laser, odom: /rackham/odometry}}}}
"""

HALL = f"""
format: 1
name: hall
until_s: 3
world:
  shapes:
    - {{name: north wall, corners_m: [0, 7.8, 12, 8], height_m: 2}}
robot_types: {{include: {ROOT}/scenarios/rackham.yaml}}
robots:
  - name: rackham
    type: rackham
    start: [2, 4, 0]
    modules: []
    bridge: []
    nodes:
"""

LISTENER = """#!/usr/bin/python3
import rospy, sys
from std_msgs.msg import String
rospy.init_node('listener')
out = open(sys.argv[1], 'w')
rospy.Subscriber('/latched', String, lambda text: out.write(f'latched {text.data}\\n'))
rospy.Subscriber('/ticks', String, lambda text: out.write(f'{rospy.get_time():.2f} {text.data}\\n'))
rospy.spin()
out.close()
"""

# Debian's module is for Debian's Python.
MAKE_BAG = """
import rosbag, rospy, sys
from std_msgs.msg import String
with rosbag.Bag(sys.argv[1], 'w', compression=sys.argv[2]) as bag:
    latched = {'callerid': '/talker', 'latching': '1', 'type': String._type, 'md5sum': String._md5sum,
               'message_definition': String._full_text, 'topic': '/latched'}
    bag.write('/latched', String('first'), rospy.Time(100), connection_header=latched)
    for i in range(20):
        bag.write('/ticks', String(str(i)), rospy.Time(100 + i // 2, i % 2 * 500000000))
"""


def output_of(*command, folder=None):
    return subprocess.run([str(word) for word in command], cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, text=True,
                          timeout=600)


def hash_of(file):
    return hashlib.sha256(file.read_bytes()).hexdigest()


class Bags(NodesCase):
    needed = (MAPPER,)

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.common = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.common.cleanup)
        cls.office = pathlib.Path(cls.common.name) / "office.bag"
        output_of(WAITPOINT, "run", ROOT / "scenarios/office.yaml", "--until", 8, "--record", cls.office)
        cls.ticks = pathlib.Path(cls.common.name) / "ticks.bag"
        made = output_of("/usr/bin/python3", "-c", MAKE_BAG, cls.ticks, "bz2")
        assert made.returncode == 0, made.stderr

    def run_text(self, text, *options):
        file = self.folder / "scenario.yaml"
        file.write_text(text)
        return output_of(WAITPOINT, "run", file, *options, folder=self.folder)

    def digest(self, done):
        return re.search(r"\n  digest +(wp1:\w+)", done.stdout).group(1)

    def listen(self, *options, play=""):
        """What a listener to a small bag writes."""
        listener = self.folder / "listener.py"
        listener.write_text(LISTENER)
        listener.chmod(0o755)
        done = self.run_text(f"format: 1\nname: ticks\nros: {{clock: true}}\nplay: {{outputs: [heard.txt]{play}}}\nnodes:\n"
                             "  - {name: listener, command: [./listener.py, heard.txt]}\n", "--play", self.ticks, *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return (self.folder / "heard.txt").read_text().splitlines(), done

    def refusal(self, bag, *options):
        done = self.run_text(MAP, "--play", bag, *options)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(done.stdout, "")
        lines = [line for line in done.stderr.splitlines() if line]
        self.assertEqual(len(lines), 1, done.stderr)
        return lines[0]

    def test_a_node_with_four_threads_makes_one_map(self):
        runs = [self.run_text(MAP, "--play", self.office, "--seed", seed) for seed in (1, 2)]
        # The library for bags looks through all packages of the machine: that is no part of the run.
        for i in range(300):
            package = self.folder / f"packages/package_{i}"
            package.mkdir(parents=True)
            (package / "package.xml").write_text(f"<package><name>package_{i}</name></package>")
        with unittest.mock.patch.dict(os.environ, ROS_PACKAGE_PATH=str(self.folder / "packages")):
            runs.append(self.run_text(MAP, "--play", self.office, "--seed", 1))
        for done in runs:
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertRegex(done.stdout, r"/rackham/laser +79\n +/rackham/odometry +399\n")
            self.assertRegex(done.stdout, r"map\.pgm +1000017 bytes, wp1:\w+\n")
        self.assertEqual(runs[0].stdout, runs[2].stdout, runs[0].stderr + runs[2].stderr)
        self.assertNotEqual(self.digest(runs[0]), self.digest(runs[1]))

    def test_debians_master_is_a_process_of_the_run(self):
        runs = [self.run_text(MAP, "--play", self.office, "--set", "ros.master=outside") for _ in range(2)]
        self.assertRegex(runs[0].stdout, r"map\.pgm +1000017 bytes", runs[0].stderr)
        self.assertEqual(runs[0].stdout, runs[1].stdout)
        self.assertIn(" 3 processes", runs[0].stderr)

    def test_messages_of_nodes_are_received(self):
        done = self.run_text(MAP, "--play", self.office, "--set", "play.hear=true")
        self.assertRegex(done.stdout, r"published +1 message to 1 topic\n +/map +1, wp1:\w+\n", done.stderr)
        self.assertNotIn("published", self.run_text(MAP, "--play", self.office, "--set", "play.hear=false").stdout)

    def test_a_file_that_was_there_before_is_no_output(self):
        (self.folder / "map.pgm").write_text("an old one")
        done = self.run_text(MAP.replace(str(MAPPER), "true"), "--play", self.office)
        self.assertRegex(done.stdout, r"map\.pgm +nothing\n")
        self.assertIn("all nodes ended", done.stdout)

    def test_times_types_and_latches_are_those_of_the_bag(self):
        heard, done = self.listen()
        self.assertEqual([line.split()[1] for line in heard], ["first", *map(str, range(20))], done.stderr)
        for i, line in enumerate(heard[1:]):
            self.assertAlmostEqual(float(line.split()[0]), 100 + i / 2, delta=0.02)
        self.assertRegex(done.stdout, r"^ticks, seed 1: 9\.5 s of ticks\.bag played; nodes were idle after ")

    def test_a_part_of_a_bag(self):
        heard, _ = self.listen(play=", start_s: 2, duration_s: 1.5")
        self.assertEqual(heard, ["latched first", "102.00 4", "102.50 5", "103.00 6", "103.50 7"])
        heard, _ = self.listen("--set", "play.topics=[/latched]")
        self.assertEqual(heard, ["latched first"])

    def test_the_rate_is_of_virtual_time(self):
        heard, fast = self.listen(play=", rate: 10")
        self.assertEqual(len(heard), 21)
        simulated = float(re.search(r"after ([\d.]+) s simulated", fast.stdout).group(1))
        self.assertLess(simulated, 5)

    def test_a_recording_beside_a_run_repeats_bit_for_bit(self):
        recorder = ('      - {name: recorder, package: rosbag, type: record, arguments: [-O, beside.bag, /scan, /odom, /tf, '
                    '/tf_static]}\n')
        hashes = set()
        for _ in range(2):
            done = self.run_text(HALL + recorder)
            self.assertEqual(done.returncode, 0, done.stderr)
            hashes.add(hash_of(self.folder / "beside.bag"))
        self.assertEqual(len(hashes), 1)
        info = output_of("/usr/bin/rosbag", "info", self.folder / "beside.bag").stdout
        self.assertRegex(info, r"/scan +\d+ msgs")
        self.assertRegex(info, r"/tf_static +1 msg ")

    def test_rosbag_play_is_a_node_that_feeds_another(self):
        nodes = (f"      - {{name: player, package: rosbag, type: play, arguments: [-q, {self.office}], after: [mapper.started]}}\n"
                 f"      - {{name: mapper, command: [{MAPPER}], remap: {{scan: /rackham/laser, odom: /rackham/odometry}}}}\n")
        hashes = set()
        for _ in range(2):
            self.run_text(HALL.replace("until_s: 3", "until_s: 8") + nodes)
            hashes.add(hash_of(self.folder / "map.pgm"))
        self.assertEqual(len(hashes), 1)
        self.assertGreater(len(set((self.folder / "map.pgm").read_bytes())), 10)

    def test_bags_that_cannot_be_played(self):
        broken = self.folder / "broken.bag"
        self.assertRegex(self.refusal(broken), r"the bag '.*broken\.bag' cannot be read$")
        broken.write_text("pictures of my cat")
        self.assertRegex(self.refusal(broken), "expected a bag of ROS 1, found something else$")
        whole = self.ticks.read_bytes()
        broken.write_bytes(whole[:-100])
        self.assertRegex(self.refusal(broken), r"is damaged: \S")
        broken.write_bytes(re.sub(rb"index_pos=.{8}", b"index_pos=" + bytes(8), self.office.read_bytes(), count=1, flags=re.S))
        self.assertRegex(self.refusal(broken), "has no index, as its recording was not closed: `rosbag reindex` makes one$")
        broken.write_bytes(whole.replace(b"compression=bz2", b"compression=xz9"))
        self.assertRegex(self.refusal(broken, "--set", "play.topics=[/ticks]"), "is damaged: .*xz9")
        self.assertRegex(self.refusal(self.ticks), "has no topic '/rackham/laser', but /latched, /ticks$")

    def test_scenarios_that_cannot_play(self):
        done = self.run_text(MAP)
        self.assertRegex(done.stderr, r"scenario\.yaml:4: expected a bag in play, or the option --play BAG, found none\n$")
        done = self.run_text("format: 1\nplay: {}\n", "--play", self.office)
        self.assertRegex(done.stderr, r"expected nodes or launch, since the bag is played to nodes of ROS, found none\n$")
        done = self.run_text(MAP, "--play", self.office, "--picture", "a.svg")
        self.assertRegex(done.stderr, "--picture: cannot be used where a bag is played in the place of a world\n$")


class Maps(unittest.TestCase):
    """One map a hundred times, and natively several."""

    runs = 100

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.bag = self.folder / "office.bag"
        output_of(WAITPOINT, "run", ROOT / "scenarios/office.yaml", "--until", 60, "--record", self.bag)

    def test_one_map_of_many_runs(self):
        maps, digests = set(), set()
        for _ in range(self.runs):
            done = output_of(WAITPOINT, "run", OFFICE_MAP, "--play", self.bag, folder=self.folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            maps.add(hash_of(self.folder / "map.pgm"))
            digests.update(re.findall(r"wp1:\w+", done.stdout + done.stderr))
        print(f"{self.runs} runs under waitpoint: {len(maps)} map", file=sys.stderr)
        self.assertEqual(len(maps), 1)

    def test_several_maps_natively(self):
        if not shutil.which("roscore"):
            self.skipTest("there is no roscore")
        runs, maps = 10, set()
        for _ in range(runs):
            done = output_of("sh", ROOT / "tests/programs/native_bag.sh", MAPPER, self.bag, self.folder / "map.pgm")
            self.assertEqual(done.returncode, 0, done.stderr)
            maps.add(hash_of(self.folder / "map.pgm"))
        print(f"{runs} runs with roscore and rosbag play: {len(maps)} maps", file=sys.stderr)
        self.assertGreater(len(maps), 1)


if __name__ == "__main__":
    if "--replay-bags" in sys.argv:
        at = sys.argv.index("--replay-bags")
        if len(sys.argv) > at + 1:
            Maps.runs = int(sys.argv.pop(at + 1))
        del sys.argv[at]
        del Bags
    else:
        del Maps
    unittest.main()
