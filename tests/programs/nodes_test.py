# SPDX-License-Identifier: BSD-3-Clause
"""Robots whose software is nodes of ROS 1: nodes_test.py BUILD [--long].

Skipped where ROS is missing: `./dev ros` installs it and builds the nodes of scenarios/office-ros.yaml.
"""

import os
import re
import subprocess
import sys
import unittest
import unittest.mock

from nodes_case import BUILD, NodesCase, ROOT, WAITPOINT

LONG = "--long" in sys.argv and not sys.argv.remove("--long")
DRIVER = BUILD / "scenarios/nodes/driver"

HALL = f"""
format: 1
name: hall
until_s: 20
world:
  shapes:
    - {{name: south wall, corners_m: [0, 0, 12, 0.2], height_m: 2}}
    - {{name: north wall, corners_m: [0, 7.8, 12, 8], height_m: 2}}
robot_types: {{include: {ROOT}/scenarios/rackham.yaml}}
robots:
  - name: rackham
    type: rackham
    start: [2, 4, 0]
    modules: []
    bridge: []
"""


class Nodes(NodesCase):
    needed = (DRIVER,)

    def run_scenario(self, scenario, *options):
        return subprocess.run([WAITPOINT, "run", scenario, *options], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                              timeout=300)

    def run_hall(self, robot, *options):
        file = self.folder / "hall.yaml"
        file.write_text(HALL + robot)
        return self.run_scenario(file, *options)

    def digests(self, done):
        return re.findall("wp1:[0-9a-f]{16}", done.stdout + done.stderr)

    def test_drive_the_office(self):
        first = self.run_scenario(ROOT / "scenarios/office-ros.yaml", "--until", "60")
        self.assertIn("goals reached     1 of 9", first.stdout, first.stderr)
        self.assertRegex(first.stdout, r"nodes: 2 goals, \d+ commands")
        self.assertRegex(first.stderr, r"observer: \d+ scans, 2 goals, nothing nearer than 0\.\d\d m")
        again = self.run_scenario(ROOT / "scenarios/office-ros.yaml", "--until", "60")
        self.assertEqual(self.digests(first), self.digests(again))
        other = self.run_scenario(ROOT / "scenarios/office-ros.yaml", "--until", "60", "--seed", "2")
        self.assertTrue(set(self.digests(first)).isdisjoint(self.digests(other)))

    def test_a_journal_repeats_the_robots_without_the_nodes(self):
        robot = f"    nodes: [{{name: driver, command: [{DRIVER}]}}]\n    goals: [[10, 4]]\n"
        journal = self.folder / "hall.journal"
        done = self.run_hall(robot, "--journal", journal)
        self.assertIn("goals reached     1 of 1", done.stdout, done.stderr)
        repeated = self.run_hall(robot, "--replay-journal", journal)
        self.assertEqual(repeated.returncode, 0, repeated.stderr)
        self.assertIn("goals reached     1 of 1", repeated.stdout)
        digest = re.search(r"digest +(wp1:\w+)", done.stdout).group(1)
        self.assertEqual(re.search(r"digest +(wp1:\w+)", repeated.stdout).group(1), digest)

    def test_a_missing_node(self):
        done = self.run_hall("    nodes:\n      - {name: driver, package: no_package, type: driver}\n")
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, r"hall\.yaml:17: there is no package 'no_package', looked for in .*\n")
        done = self.run_hall("    nodes:\n      - {name: driver, command: [./nowhere]}\n")
        self.assertRegex(done.stderr, r"/driver: cannot be started: .*nowhere: No such file or directory")

    def test_a_goal_is_shown_again_to_a_driver_that_lost_it(self):
        node = self.node("forgets.py", "import rospy\nfrom geometry_msgs.msg import PoseStamped\nrospy.init_node('forgets')\n"
                         "count = []\ndef take(goal):\n    count.append(goal)\n"
                         "    print('goal', len(count), goal.pose.position.x, rospy.get_time() % 100)\n"
                         "rospy.Subscriber('move_base_simple/goal', PoseStamped, take)\nrospy.spin()\n")
        done = self.run_hall(f"    nodes: [{{name: forgets, command: [{node}], output: screen}}]\n    goals: [[9, 4]]\n",
                             "--until", "15")
        self.assertEqual(re.findall("goal ([0-9]) 9.0", done.stdout + done.stderr), ["1", "2"], done.stderr)

    def test_lists_of_maps_among_the_parameters(self):
        node = self.node("reader.py", "import rospy\nrospy.init_node('reader')\nprint('read', rospy.get_param('~plugins'))\n")
        done = self.run_hall(f"    nodes: [{{name: reader, command: [{node}], output: screen, required: true, "
                             "params: {plugins: [{name: walls, sizes: [1, {of: 2.5}]}, {}]}}]\n")
        self.assertIn("read [{'name': 'walls', 'sizes': [1, {'of': 2.5}]}, {}]", done.stdout + done.stderr)

    def test_a_node_that_dies(self):
        node = self.node("dies", "import sys, time\ntime.sleep(3)\nsys.exit(7)\n")
        done = self.run_hall(f"    nodes: [{{name: frail, command: [{node}], required: true}}]\n")
        self.assertRegex(done.stderr, r" 3\.\d+ s  /frail: ended with status 7\n")
        self.assertRegex(done.stdout, r"after 3\.[01] s simulated")

    def test_a_node_that_hangs_at_its_start(self):
        node = self.node("hangs", "import time\ntime.sleep(1000)\n")
        done = self.run_hall(f"    nodes: [{{name: stuck, command: [{node}]}}]\n")
        self.assertRegex(done.stderr, r"10\.\d+ s  /stuck: has not registered with the master in 10 s\n")

    def test_speeds_that_are_no_numbers(self):
        node = self.node("nan", "import rospy\nfrom geometry_msgs.msg import Twist\nrospy.init_node('nan')\n"
                         "out = rospy.Publisher('cmd_vel', Twist, queue_size=1)\nspeed = Twist()\nspeed.linear.x = float('nan')\n"
                         "while not rospy.is_shutdown():\n    out.publish(speed)\n    rospy.sleep(0.1)\n")
        done = self.run_hall(f"    nodes: [{{name: nan, command: [{node}]}}]\n", "--until", "5")
        self.assertEqual(done.stderr.count("cmd_vel: expected finite speeds of at most 10000, found others"), 1, done.stderr)
        self.assertRegex(done.stdout, r"nodes: 0 goals, 0 commands, \d+ speeds that are no numbers, or too great")

    def test_speeds_with_errors_of_rounding(self):
        node = self.node("noisy", "import rospy\nfrom geometry_msgs.msg import Twist\nrospy.init_node('noisy')\n"
                         "out = rospy.Publisher('/cmd_vel', Twist, queue_size=1)\nspeed = Twist()\nspeed.linear.x = 0.3\n"
                         "speed.angular.z = 1e-17\nrate = rospy.Rate(10)\n"
                         "while not rospy.is_shutdown(): out.publish(speed); rate.sleep()\n")
        scenario = f"    nodes: [{{name: noisy, command: [{node}]}}]\n"
        done = self.run_hall(scenario, "--until", "5")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"distance driven +[1-9]")
        with unittest.mock.patch.dict(os.environ, ROS_NAMESPACE="elsewhere", ROS_HOSTNAME="nowhere"):
            again = self.run_hall(scenario, "--until", "5")
        self.assertEqual(self.digests(again)[0], self.digests(done)[0])

    def test_missing_topic_ends_the_wait(self):
        node = self.node("late", "")
        done = self.run_hall(f"    nodes: [{{name: late, command: [{node}], after: ['topic:/never']}}]\n", "--until", "2",
                             "--set", "expect={topics: ['/nix>=0']}")
        self.assertEqual(done.returncode, 1)
        self.assertIn("not as expected: node /late was not started", done.stderr)
        self.assertIn("not as expected: topic /nix had no message", done.stderr)

    def test_names_and_ranks_that_cannot_be(self):
        done = self.run_hall(f"    nodes: [{{name: waitpoint, command: ['true']}}]\n")
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
        self.assertIn("hall.yaml:16: a node cannot be called '/waitpoint'", done.stderr)
        done = self.run_hall(f"    nodes: [{{name: some, command: ['true']}}]\n", "--ranks", "2")
        self.assertEqual(done.returncode, 2)
        self.assertIn("--ranks: cannot be used for a scenario with nodes", done.stderr)

    def test_a_flood_of_speeds(self):
        node = self.node("flood", "import rospy\nfrom geometry_msgs.msg import Twist\nrospy.init_node('flood')\n"
                         "out = rospy.Publisher('cmd_vel', Twist, queue_size=1)\n"
                         "while not rospy.is_shutdown(): out.publish(Twist())\n")
        done = self.run_hall(f"    nodes: [{{name: flood, command: [{node}]}}]\n", "--until", "3")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("cmd_vel: expected at most 500 messages a second, found more", done.stderr)

    def test_a_series_of_seeds(self):
        series = self.run_hall(f"    nodes: [{{name: driver, command: [{DRIVER}]}}]\n    goals: [{{x_m: 4, y_m: 4}}]\n", "--seeds", "3..4")
        self.assertEqual(series.returncode, 0, series.stderr)
        rows = [line.split() for line in series.stdout.splitlines() if line.strip()[:1] in ("3", "4")]
        self.assertEqual([row[0] for row in rows], ["3", "4"])
        for row in rows:
            alone = self.run_scenario(self.folder / "hall.yaml", "--seed", row[0])
            self.assertEqual(self.digests(alone)[0], row[-1])
    def test_computing_takes_the_time_of_a_node_s_clock(self):
        node = self.node("calls", "import os, time\nbegin = time.monotonic()\nfor _ in range(100):\n    os.write(2, b'')\n"
                         "print('took', (time.monotonic() - begin) * 1000, 'ms', flush=True)\ntime.sleep(100)\n")
        slow = f"{{name: slow, command: [{node}], output: screen, clock: 'fixed:100'}}"
        done = self.run_hall(f"    nodes: [{{name: quick, command: [{node}], output: screen}}, {slow}]\n", "--until", "3")
        quick_ms, slow_ms = sorted(float(ms) for ms in re.findall(r"took (\S+) ms", done.stderr))
        self.assertLess(quick_ms, 10)
        self.assertGreater(slow_ms, 50)
        done = self.run_hall(f"    nodes: [{{name: slow, command: [{node}], clock: cpu}}]\n")
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, r"hall\.yaml:16: expected the clock of node 'slow' to be fixed:US, .*, found 'cpu'\n")

    def test_pictures_and_recordings_have_the_topics_of_nodes(self):
        node = self.node("belief", "import rospy\nfrom geometry_msgs.msg import Pose, PoseArray\n"
                         "rospy.init_node('belief')\nout = rospy.Publisher('cloud', PoseArray, queue_size=1, latch=True)\n"
                         "cloud = PoseArray(poses=[Pose() for _ in range(7)])\nfor i, pose in enumerate(cloud.poses):\n"
                         "    pose.position.x, pose.position.y, pose.orientation.w = 1 + i, 5, 1\n"
                         "cloud.header.frame_id, cloud.header.stamp = 'map', rospy.Time.now()\nout.publish(cloud)\nrospy.spin()\n")
        robot = (f"    ros: {{show: {{plan: path, cloud: cloud, /map: grid}}}}\n    goals: [[10, 4]]\n"
                 f"    nodes: [{{name: driver, command: [{DRIVER}]}}, {{name: belief, command: [{node}]}}]\n")
        plain = self.run_hall(robot, "--until", "6")
        picture, mcap, bag = (self.folder / name for name in ("hall.svg", "hall.mcap", "hall.bag"))
        shown = self.run_hall(robot, "--until", "6", "--picture", picture, "--record", mcap)
        self.assertIn("digest", plain.stdout, plain.stderr)
        self.assertEqual(re.search(r"  digest +(wp1:\w+)", shown.stdout).group(1),
                         re.search(r"  digest +(wp1:\w+)", plain.stdout).group(1))
        drawn = picture.read_text()
        for words in "paths of nodes", "poses of a node", "grid of a node":
            self.assertIn(words, drawn)
        self.assertEqual(drawn.count('r="1.6"'), 7)
        for words in b"/plan", b"/cloud", b"foxglove.PosesInFrame":
            self.assertIn(words, mcap.read_bytes())
        self.run_hall(robot, "--until", "6", "--record", bag)
        for words in b"/plan", b"nav_msgs/Path", b"geometry_msgs/PoseArray", b"nav_msgs/OccupancyGrid":
            self.assertIn(words, bag.read_bytes())
        refused = self.run_hall("    ros: {show: {plan: line}}\n")
        self.assertRegex(refused.stderr, r"hall\.yaml:16: expected the kind of 'plan' to be path, cloud or grid, found 'line'\n")

    def test_options_that_exclude_nodes(self):
        for option in ["--serve"], ["--speed", "1"], ["--verify"], ["--interactive"]:
            done = self.run_hall(f"    nodes: [{{name: driver, command: [{DRIVER}]}}]\n", *option)
            self.assertEqual(done.returncode, 2)
            self.assertIn(f"{option[0]}: cannot be used for a scenario with nodes", done.stderr)

    @unittest.skipUnless(LONG, "takes long: --long")
    def test_a_hundred_runs(self):
        """Of the office, every third one beside two loops that compute, every tenth one in gdb."""
        scenario, found = ROOT / "scenarios/office-ros.yaml", set()
        for number in range(1, 101):
            under = ["gdb", "-batch", "-ex", "run", "--args"] if number % 10 == 0 else []
            loops = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(2 if number % 3 == 0 else 0)]
            try:
                done = subprocess.run([*under, WAITPOINT, "run", scenario], stdin=subprocess.DEVNULL, capture_output=True,
                                      text=True, timeout=1200)
            finally:
                for loop in loops:
                    loop.kill()
                    loop.wait()
            found.add(tuple(self.digests(done)))
            self.assertEqual(len(found), 1, found)
            self.assertEqual(len(self.digests(done)), 2, done.stderr)
            if number % 10 == 0:
                print(f"{number} runs of 100: {' '.join(*found)}", flush=True)


if __name__ == "__main__":
    unittest.main()
