# SPDX-License-Identifier: BSD-3-Clause
"""What nodes of ROS of several robots say to each other, over a medium: nodes_of_robots_test.py BUILD.

Skipped where ROS is missing: `./dev ros` installs it.
"""

import re
import socket
import subprocess
import unittest

from nodes_case import BUILD, NodesCase, ROOT, WAITPOINT

TWO = """
format: 1
name: two
until_s: 5
world: {{shapes: [{{corners_m: [0, 0, 1, 1]}}]}}
robot_types: {{include: {root}/scenarios/rackham.yaml}}
{medium}
robots:
  - {{name: ada, type: rackham, start: [5, 5, 0], modules: [], bridge: [], nodes: [{ada}]}}
  - {{name: bea, type: rackham, start: [9, 5, 0], modules: [], bridge: [], nodes: [{bea}]}}
"""

NODES = {
    "talk": """import rospy
from std_msgs.msg import Header
rospy.init_node("talk")
out = rospy.Publisher("/words", Header, queue_size=10)
for number in range(1000):
    out.publish(Header(stamp=rospy.Time.now(), frame_id=str(number)))
    rospy.sleep(0.1)
""",
    "hear": """import rospy
from std_msgs.msg import Header
rospy.init_node("hear")
def take(word):
    print(rospy.get_name(), word.frame_id, "after", (rospy.Time.now() - word.stamp).to_sec() * 1000, "ms", flush=True)
rospy.Subscriber("/words", Header, take)
rospy.spin()
""",
    # Not of ROS: datagrams, as UDPROS sends them.
    "send": """import socket, struct, time
one = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
time.sleep(1)
for number in range(40):
    one.sendto(struct.pack("id", number, time.time()), ("127.0.0.1", {port}))
    time.sleep(0.01)
time.sleep(100)
""",
    "receive": """import socket, struct, time
one = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
one.bind(("127.0.0.1", {port}))
while True:
    number, sent = struct.unpack("id", one.recv(100))
    print("datagram", number, "after", (time.time() - sent) * 1000, "ms", flush=True)
""",
}


def free_port():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


class NodesOfRobots(NodesCase):
    def setUp(self):
        super().setUp()
        port = free_port()
        for name, text in NODES.items():
            self.node(name, text.replace("{port}", str(port)))

    def run_two(self, medium, ada, bea, *options):
        """The run; and what was heard: (who, number, delay in ms)."""
        def list_of(names):
            return ", ".join(f"{{name: {name}, command: [./{name}], output: screen}}" for name in names)

        file = self.folder / "two.yaml"
        file.write_text(TWO.format(root=ROOT, medium=medium, ada=list_of(ada), bea=list_of(bea)))
        done = subprocess.run([WAITPOINT, "run", file, *options], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                              timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        heard = [(who, int(number), float(ms)) for who, number, ms in re.findall(r"(\S+) (\d+) after (\S+) ms", done.stderr)]
        return done, heard

    def test_words_take_the_time_of_the_medium_or_of_the_delay_within_a_robot(self):
        _, heard = self.run_two("medium: {latency_ms: 25}\nros: {delay_us: 3000}", ["talk", "hear"], ["hear"])
        within = [ms for who, _, ms in heard if who == "/ada/hear"]
        between = [ms for who, _, ms in heard if who == "/bea/hear"]
        self.assertGreater(min(len(within), len(between)), 15, heard)
        self.assertTrue(3 <= min(within) <= max(within) < 5, within)
        self.assertTrue(25 <= min(between) <= max(between) < 27, between)

    def test_streams_are_late_and_datagrams_missing_where_the_medium_loses(self):
        def lossy(*options):
            return self.run_two("medium: {latency_ms: [20, 30], loss: 0.3}", ["talk", "send"], ["hear", "receive"], *options)

        done, heard = lossy()
        words = [number for who, number, _ in heard if who == "/bea/hear"]
        self.assertEqual(words, list(range(words[0], words[0] + len(words))))
        delays = [ms for who, _, ms in heard if who == "/bea/hear"]
        self.assertTrue(20 <= min(delays) < 30 and max(delays) > 220, delays)
        datagrams = [ms for who, _, ms in heard if who == "datagram"]
        self.assertTrue(20 <= len(datagrams) < 40, datagrams)
        self.assertTrue(20 <= min(datagrams) <= max(datagrams) < 31, datagrams)
        self.assertRegex(done.stdout, r"\d+ messages lost between robots, \d+ pieces sent again between robots")
        self.assertEqual(lossy()[1], heard)

    def test_robots_beyond_the_range_do_not_hear_each_other(self):
        _, heard = self.run_two("medium: {latency_ms: 20, range_m: 3}", ["talk", "hear"], ["hear"])
        self.assertEqual({who for who, _, _ in heard}, {"/ada/hear"})


if __name__ == "__main__":
    unittest.main()
