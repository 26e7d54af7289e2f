# SPDX-License-Identifier: BSD-3-Clause
"""Foxglove sees a run while it goes, which is the same run: foxglove_test.py BUILD."""

import json
import os
import pathlib
import random
import signal
import socket
import struct
import subprocess
import tempfile
import unittest

from installed import main
from mcap_records import messages
from view_test import PART, SECOND, Viewed, digest_in, run
from web_socket import BINARY, TEXT, Refused, WebSocket

STEP = SECOND // 100  # of the office's world
MESSAGE, TIME = 1, 2
INFORMATION, WARNING, ERROR = 0, 1, 2
PROTOCOL = "Sec-WebSocket-Protocol"
MAP, FRAMES, CLOCK = "/world", "/tf", "/clock"
SCAN, POSITION, LINES, GOALS = (f"/rackham/{name}" for name in ("laser", "position", "modules", "goals"))


class Foxglove(WebSocket):
    """A client of the protocol; its subscriptions are numbered from 100 on, by channel."""

    def __init__(self, url, protocol="foxglove.websocket.v1", **headers):
        super().__init__(url, "/foxglove", **({PROTOCOL: protocol} if protocol else {}), **headers)
        self.channels, self.statuses, self.time = {}, [], -1
        self.info = self.receive()
        while not self.channels:
            self.next()

    def order(self, op, **members):
        self.send(json.dumps({"op": op, **members}).encode())

    def subscribe(self, *topics):
        self.order("subscribe", subscriptions=[{"id": 100 + self.channels[topic]["id"], "channelId": self.channels[topic]["id"]}
                                               for topic in topics])

    def unsubscribe(self, *topics):
        self.order("unsubscribe", subscriptionIds=[100 + self.channels[topic]["id"] for topic in topics])

    def next(self):
        """The next message of a topic as (topic, time, bytes), or None for any other message."""
        kind, data = self.receive_message()
        if kind == TEXT:
            self.hear(json.loads(data))
        elif data[0] == TIME:
            time, = struct.unpack("<Q", data[1:])
            assert time > self.time
            self.time = time
        else:
            code, subscription, time = struct.unpack_from("<BIQ", data)
            assert code == MESSAGE
            topic = next(name for name, channel in self.channels.items() if channel["id"] == subscription - 100)
            return topic, time, data[13:]
        return None

    def hear(self, message):
        if message["op"] == "advertise":
            self.channels |= {channel["topic"]: channel for channel in message["channels"]}
        else:
            assert message["op"] == "status"
            self.statuses.append(message)

    def message(self):
        """The next message of a topic."""
        while not (message := self.next()):
            pass
        return message

    def until(self, is_enough):
        """The messages of topics up to the state that is enough: {topic: [(time, bytes)]}."""
        found = {}
        while not is_enough(self):
            if message := self.next():
                found.setdefault(message[0], []).append(message[1:])
        return found

    def status(self):
        """The next status."""
        self.until(lambda client: client.statuses)
        return self.statuses.pop(0)


def ended(client):
    return any("the run is over" in status["message"] for status in client.statuses)


class Live(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_its_messages_are_those_of_the_recording(self):
        plain = run(*PART, "--until", "12", "--record", self.folder / "plain.mcap")
        recorded = messages((self.folder / "plain.mcap").read_bytes())
        with Viewed(*PART, "--until", "12", "--speed", "1", "--serve-control", "--record", self.folder / "viewed.mcap") as viewed:
            client = Foxglove(viewed.url)
            self.assertEqual((client.info["op"], client.info["capabilities"]), ("serverInfo", ["time"]))
            self.assertEqual(set(client.channels), set(recorded) - {GOALS})
            scan = client.channels[SCAN]
            self.assertEqual((scan["encoding"], scan["schemaName"], scan["schemaEncoding"]),
                             ("json", "foxglove.LaserScan", "jsonschema"))
            self.assertIn("ranges", json.loads(scan["schema"])["properties"])
            client.until(lambda client: client.time > SECOND // 2)
            client.subscribe(*client.channels)
            viewed.client().ask("speed", value=0)
            got = client.until(ended)
            page = viewed.client()
            page.ask("header")
            while not (log := page.receive()).get("kind") == "log":
                pass
            self.assertTrue(log["lines"], "the recording has not taken the lines from the page")
            self.assertEqual(viewed.end(), 0, viewed.errors)
        self.assertEqual(digest_in(viewed.output), digest_in(plain.stdout))
        self.assertEqual((self.folder / "viewed.mcap").read_bytes(), (self.folder / "plain.mcap").read_bytes())
        begun = got[CLOCK][0][0]  # what there is then comes first, at that time, and is not sent again at the next step
        self.assertLess(begun, 11 * SECOND)
        for topic, sent in got.items():
            first = [message for message in sent if message[0] == begun]
            next_step = [message for message in sent if begun < message[0] <= begun + STEP]
            later = [message for message in sent if message[0] > begun + STEP]
            self.assertTrue(sent == first + next_step + later, topic)
            self.assertTrue(later == [message for message in recorded[topic] if message[0] > begun + STEP], topic)
            self.assertTrue(later or topic in (MAP, LINES), topic)
            self.assertTrue(all(message in recorded[topic] for message in next_step), topic)
            if topic in (MAP, SCAN):
                published = [data for time, data in recorded[topic] if time <= begun]
                self.assertTrue([data for _, data in first] == published[-1:], topic)
        self.assertEqual(len(got[MAP]), 1)

    def test_only_what_is_subscribed_is_sent(self):
        with Viewed("--speed", "10") as viewed:
            one, other = Foxglove(viewed.url), Foxglove(viewed.url, "foxglove.sdk.v1")
            one.subscribe(CLOCK)
            other.subscribe(POSITION, MAP)
            self.assertEqual({one.message()[0] for _ in range(30)}, {CLOCK})
            self.assertEqual({other.message()[0] for _ in range(30)}, {MAP, POSITION})
            other.unsubscribe(POSITION)
            one.subscribe(MAP)  # which another one has got already
            self.assertIn(MAP, {one.message()[0] for _ in range(30)})
            other.subscribe(CLOCK)
            while other.message()[0] == POSITION:
                pass
            self.assertEqual({other.message()[0] for _ in range(30)}, {CLOCK})
            other.order("subscribe", subscriptions=[{"id": 7, "channelId": other.channels[CLOCK]["id"]}])
            other.order("subscribe", subscriptions=[{"id": 8, "channelId": 99}])
            other.order("unsubscribe", subscriptionIds=[3])
            self.assertEqual([other.status()["message"] for _ in range(3)],
                             [f"subscription 7: there is another one of channel {other.channels[CLOCK]['id']}",
                              "subscription 8: there is no channel 99", "there is no subscription 3"])
            self.assertNotEqual(one.info["sessionId"], "")
            self.assertEqual(one.info["sessionId"], other.info["sessionId"])

    def test_a_run_that_is_held_or_over_is_seen_as_it_is(self):
        with Viewed(*PART, "--until", "20", "--speed", "2", "--serve-control") as viewed:
            page, client = viewed.client(), Foxglove(viewed.url)
            client.until(lambda client: client.time > SECOND // 2)
            page.ask("pause", on=True)
            client = Foxglove(viewed.url)
            client.subscribe(MAP, FRAMES)
            self.assertEqual([client.message()[0] for _ in range(4)], [MAP] + 3 * [FRAMES])
            page.ask("speed", value=0)
            page.ask("pause", on=False)
            viewed.wait_for_end_of_run()
            late = Foxglove(viewed.url)
            late.until(lambda client: GOALS in client.channels)
            late.subscribe(MAP, FRAMES, POSITION, SCAN, LINES)
            last = {}
            while not {MAP, FRAMES, POSITION, SCAN} <= last.keys() or len(last[FRAMES]) < 3:
                topic, time, data = late.message()
                last.setdefault(topic, []).append((time, json.loads(data)))
            self.assertEqual({(frame["parent_frame_id"], frame["child_frame_id"]) for _, frame in last[FRAMES]},
                             {("world", "rackham"), ("world", "rackham/position"), ("rackham/position", "rackham/laser")})
            self.assertGreaterEqual(last[POSITION][0][0], 19 * SECOND)
            self.assertEqual(viewed.end(), 0, viewed.errors)

    def test_goals_are_told_at_the_end(self):
        with Viewed("--until", "60") as viewed:
            viewed.wait_for_end_of_run()
            client = Foxglove(viewed.url)
            client.until(lambda client: GOALS in client.channels)
            client.subscribe(GOALS)
            self.assertRegex(json.loads(client.message()[2])["message"], r"^[^(]+ \(\d+\.\d+, \d+\.\d+\): reached")

    def test_the_death_of_the_run_is_told_and_what_was_seen_before_is_kept(self):
        with Viewed("--speed", "5") as viewed:
            client = Foxglove(viewed.url)
            client.subscribe(CLOCK)
            before = [client.message()[1] for _ in range(5)]
            children = subprocess.run(["pgrep", "-P", str(viewed.process.pid)], capture_output=True, text=True).stdout
            os.kill(int(children.split()[0]), signal.SIGKILL)
            client.until(ended)
            self.assertEqual([(status["level"], status["message"]) for status in client.statuses],
                             [(ERROR, "the run is over: crashed")])
            late = Foxglove(viewed.url)
            late.subscribe(CLOCK)
            self.assertGreaterEqual(late.message()[1], before[-1])
            self.assertEqual(viewed.end(), 128 + signal.SIGKILL)

    def test_clients_that_come_subscribe_and_leave_leave_the_digest_alone(self):
        plain = run(*PART, "--until", "60")
        chance = random.Random(3)
        with Viewed(*PART, "--until", "60", "--speed", "60") as viewed:
            clients = []
            for _ in range(40):
                if clients and chance.random() < 0.4:
                    clients.pop(chance.randrange(len(clients))).close()
                if len(clients) < 8:
                    clients.append(Foxglove(viewed.url))
                client = chance.choice(clients)
                topics = chance.sample(sorted(client.channels), 4)
                client.subscribe(*topics)
                client.message()
                client.unsubscribe(*topics)
                if chance.random() < 0.3:
                    client.subscribe(topics[0])
                    client.close()
                    clients.remove(client)
            viewed.wait_for_end_of_run()
            self.assertEqual(viewed.end(), 0, viewed.errors)
        self.assertEqual(digest_in(viewed.output), digest_in(plain.stdout))

    def test_a_slow_client_gets_fewer_messages_and_does_not_hold_up_the_run(self):
        with Viewed(*PART, "--until", "300") as viewed:
            client = Foxglove(viewed.url)
            client.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 16)
            client.subscribe(*client.channels)
            viewed.wait_for_end_of_run()
            client.until(lambda client: client.statuses)
            self.assertIn("not take them fast enough", client.statuses[0]["message"])
            self.assertEqual(client.statuses[0]["level"], WARNING)
            self.assertEqual(viewed.end(), 0, viewed.errors)

    def test_strangers_are_refused(self):
        app = "https://app.foxglove.dev"
        with Viewed(*PART, "--until", "2") as viewed:
            own = viewed.url.split("/?")[0]
            for protocol in ("foxglove.sdk.v1", "rosbridge, foxglove.websocket.v1"):
                self.assertIn(f"{PROTOCOL}: {protocol.split(', ')[-1]}", Foxglove(viewed.url, protocol, Origin=own).answer)
            for protocol, headers in ((None, {}), ("foxglove.websocket.v2", {}), ("foxglove.sdk.v1", {"Origin": app}),
                                      ("foxglove.sdk.v1", {"Origin": "null"}), ("foxglove.sdk.v1", {"Host": "evil.example"})):
                with self.assertRaises(Refused):
                    Foxglove(viewed.url, protocol, **headers)
            with self.assertRaises(Refused):
                Foxglove(viewed.url.split("token=")[0] + "token=0")
            with self.assertRaises(Refused):
                viewed.client(Origin=app)
            viewed.wait_for_end_of_run()
            self.assertEqual(viewed.end(), 0)
        with Viewed(*PART, "--until", "2", "--serve-origin", app, "--serve-origin", "file://") as viewed:
            for origin in (app, "file://"):
                self.assertIn(CLOCK, Foxglove(viewed.url, Origin=origin).channels)
            for options in ({"Origin": "http://app.foxglove.dev"}, {"Origin": app + ".evil.example"}):
                with self.assertRaises(Refused):
                    Foxglove(viewed.url, **options)
            with self.assertRaises(Refused):  # they may look, not act
                viewed.client(Origin=app)

    def test_who_is_refused_for_its_origin_is_told_how_to_allow_it(self):
        with Viewed(*PART, "--until", "2") as viewed:
            viewed.wait_for_end_of_run()
            for _ in range(2):
                with self.assertRaises(Refused):
                    Foxglove(viewed.url, Origin="https://app.foxglove.dev")
            with self.assertRaises(Refused):
                Foxglove(viewed.url, Origin="\x1b[31mred")
            viewed.end()
        self.assertEqual(viewed.errors.count("--serve-origin https://app.foxglove.dev allows it"), 1)
        self.assertNotIn("red", viewed.errors)

    def test_malformed_messages_are_answered_or_end_their_connection(self):
        chance = random.Random(4)
        sound = [{"op": "subscribe", "subscriptions": [{"id": 1, "channelId": 0}]}, {"op": "unsubscribe", "subscriptionIds": [1]},
                 {"op": "advertise", "channels": [{"id": 1, "topic": "x", "encoding": "json", "schemaName": "x"}]},
                 {"op": "getParameters", "parameterNames": [], "id": "a"}, {"op": "fetchAsset", "uri": "x", "requestId": 1}]
        strange = [None, True, -1, 1.5, 1e300, 2**64, "", "x", [], [[]], {}, [{}], {"id": -1}, [{"id": 0, "channelId": 2**40}]]

        def bend(value):
            """The same with a part of it replaced."""
            if chance.random() < 0.3 or not isinstance(value, (dict, list)) or not value:
                return chance.choice(strange)
            value = dict(value) if isinstance(value, dict) else list(value)
            at = chance.choice(list(value) if isinstance(value, dict) else range(len(value)))
            return {**value, at: bend(value[at])} if isinstance(value, dict) else value[:at] + [bend(value[at])] + value[at + 1:]

        with Viewed(*PART, "--until", "5") as viewed:
            client = Foxglove(viewed.url)
            for _ in range(300):
                choice = chance.random()
                if choice < 0.6:
                    client.send(json.dumps(bend(chance.choice(sound))).encode())
                elif choice < 0.8:
                    data = json.dumps(chance.choice(sound)).encode()
                    client.send(data[:chance.randrange(len(data))])
                else:
                    client.send(bytes([chance.choice((MESSAGE, TIME, 3, 255))]) + chance.randbytes(chance.randrange(20)), BINARY)
            client.send(b"[" * 100_000)
            client.order("no such operation")
            client.until(lambda client: client.statuses and "no such operation" in client.statuses[-1]["message"])
            self.assertTrue(all(status["level"] == ERROR for status in client.statuses if "over" not in status["message"]))
            self.assertGreater(len(client.statuses), 200)
            for _ in range(60):
                other = Foxglove(viewed.url)
                other.socket.sendall(chance.randbytes(chance.randrange(1, 200)))
                other.close()
            other = Foxglove(viewed.url)
            with self.assertRaises((ConnectionError, OSError)):
                other.send(b" " * 2_000_000)
                other.until(lambda client: False)
            client.subscribe(MAP)
            self.assertEqual(client.message()[0], MAP)
            viewed.wait_for_end_of_run()
            self.assertEqual(viewed.end(), 0, viewed.errors)

    def test_mistakes_in_the_options_are_one_line(self):
        for options in (("--serve-origin", "https://app.foxglove.dev"), ("--serve", "--serve-origin", "app.foxglove.dev"),
                        ("--serve", "--serve-origin", "https://app.foxglove.dev/")):
            done = run(*PART, "--until", "1", *options)
            self.assertEqual((done.returncode, done.stdout), (2, ""), options)
            self.assertRegex(done.stderr, r"^[^\n]*--serve-origin[^\n]*\n$")


if __name__ == "__main__":
    main()
