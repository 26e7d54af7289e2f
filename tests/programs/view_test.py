# SPDX-License-Identifier: BSD-3-Clause
"""A run is viewed, its past too, and is the same run: view_test.py BUILD."""

import base64
import gzip
import json
import os
import pathlib
import random
import re
import signal
import subprocess
import sys
import tempfile
import unittest
from urllib.parse import urlsplit

from installed import main
from viewed import PART, SECOND, Viewed, digest_in, run
from web_socket import CLOSE, PING, Refused, WebSocket


class View(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def events(self, *options):
        """The lines of --events, and the run."""
        done = run(*options, "--events", self.folder / "events")
        return (self.folder / "events").read_text().splitlines()[1:], done

    def event_lines(self, header, events):
        """What the columns say, as --events has it."""
        time = events["from"]
        for step, task, operation, thing in zip(events["t"], events["k"], events["o"], events["x"]):
            time += step
            line = f"{time // SECOND}.{time % SECOND:09d} {events['tasks'][task][2]} {events['tasks'][task][1]} " \
                   f"{header['operations'][operation]}"
            if thing >= 0:
                kind, number, label, _ = events["objects"][thing]
                line += f" {kind}#{number}" + (f' "{label}"' if label else "")
            yield line

    def test_a_page_has_every_event_and_the_poses_of_the_run_which_is_the_same(self):
        lines, plain = self.events(*PART, "--until", "20")
        shown = run(*PART, "--until", "20", "--page", self.folder / "run.html", "--trajectory", self.folder / "path.tum")
        self.assertEqual(digest_in(shown.stdout), digest_in(plain.stdout))
        page = (self.folder / "run.html").read_text()
        data = json.loads(gzip.decompress(base64.b64decode(re.search(r'<script id="run"[^>]*>([^<]*)<', page)[1])))
        self.assertEqual(list(self.event_lines(data["header"], data["events"])), lines)
        last = data["frames"][-1]
        self.assertEqual((last["time"], last["events"]), (20 * SECOND, len(lines)))
        stamp, *pose = (float(word) for word in (self.folder / "path.tum").read_text().splitlines()[-1].split())
        frame = next(frame for frame in data["frames"] if abs(frame["time"] - stamp * SECOND) < 0.02 * SECOND)
        for of_page, of_path in zip(frame["robots"][0]["truth"], pose[:2]):
            self.assertAlmostEqual(of_page, of_path, delta=0.02, msg="at most 1 m/s")
        self.assertIn(digest_in(plain.stdout), data["summary"])
        plot = next(p for p in data["plots"] if (p["poster"], p["field"]) == ("pom.position", "position.pose.x"))
        self.assertAlmostEqual(plot["v"][-1], last["robots"][0]["estimate"][0], delta=0.1)
        counted = data["counts"]["periods"]
        self.assertAlmostEqual(sum(map(sum, data["counts"]["events"])),
                               sum(float(line.split()[0]) <= counted for line in lines), delta=100)
        self.assertNotRegex(page, r'(src|href)="http')

    def test_the_past_of_a_run_is_the_past(self):
        lines, plain = self.events(*PART, "--until", "30")
        with Viewed(*PART, "--until", "30") as viewed:
            viewed.wait_for_end_of_run()
            client = viewed.client()
            header = client.ask("header")
            for second in (20, 7, 12):
                before = sum(float(line.split()[0]) <= second for line in lines)
                frame = client.ask("seek", line=0, time=second * SECOND)
                self.assertEqual((frame["time"], frame["events"]), (second * SECOND, before))
                step = client.ask("step", line=0, count=1)
                self.assertEqual((step["events"], step["event"]["text"]), (before + 1, lines[before]))
            back = client.ask("step", line=0, count=-3)
            self.assertEqual(back["events"], before - 2)
            executive = next(task["number"] for task in client.ask("tasks", line=0)["tasks"] if task["name"] == "rflex.motion")
            there = client.ask("step", line=0, count=-1, task=executive)["events"]
            own = [i for i, line in enumerate(lines[:back["events"]], 1) if " rflex.motion " in line]
            self.assertEqual(there, own[-2])
            events = client.ask("events", line=0, **{"from": 9 * SECOND, "to": 10 * SECOND})
            self.assertEqual(list(self.event_lines(header, events)),
                             [line for line in lines if 9 <= float(line.split()[0]) < 10])
            self.assertTrue(lines[events["first"] - 1].startswith("9.0"))
            stack = client.ask("stack", line=0, event=events["first"] + 5)
            self.assertIn(stack["task"].split(" of ")[0], lines[events["first"] + 4])
            world = next(i for i, line in enumerate(lines[before:], before + 1) if " world sleep" in line)
            self.assertIn("run_world", client.ask("stack", line=0, event=world)["frames"][-1]["function"])
            tasks = client.ask("tasks", line=0)["tasks"]
            self.assertIn("executive", [task["name"] for task in tasks])
            self.assertEqual(viewed.end(), 0, viewed.errors)
            self.assertEqual(digest_in(viewed.output), digest_in(plain.stdout))

    def test_clients_that_come_and_go_leave_the_digest_alone(self):
        plain = run(*PART, "--until", "60")
        chance = random.Random(1)
        with Viewed(*PART, "--until", "60", "--speed", "60") as viewed:
            clients = []
            for _ in range(30):
                if clients and chance.random() < 0.4:
                    clients.pop(chance.randrange(len(clients))).close()
                client = viewed.client()
                client.ask("follow", on=True, rate=60, view=None, scans=chance.random() < 0.5)
                client.ask("seek", line=0, time=chance.randrange(60) * SECOND)
                clients.append(client)
                if len(clients) > 8:
                    clients.pop(0).close()
            viewed.wait_for_end_of_run()
            self.assertEqual(viewed.end(), 0, viewed.errors)
        self.assertEqual(digest_in(viewed.output), digest_in(plain.stdout))

    def test_the_run_is_paused_and_paced_where_viewers_control_it(self):
        with Viewed(*PART, "--until", "60", "--speed", "20", "--serve-control") as viewed:
            client = viewed.client()
            self.assertNotIn("error", client.ask("pause", on=True))
            client.ask("follow", on=True)
            frames = []
            while len(frames) < 4:
                pushed = client.receive()
                if pushed.get("kind") == "frame":
                    frames.append(pushed["time"])
            self.assertEqual(frames[-1], frames[-2])
            client.ask("speed", value=0)
            client.ask("pause", on=False)
            viewed.wait_for_end_of_run()
            self.assertEqual(viewed.end(), 0, viewed.errors)

    def test_strangers_are_refused(self):
        with Viewed(*PART, "--until", "2") as viewed:
            status, page, headers = viewed.request()
            self.assertEqual(status, 200)
            self.assertIn("<!doctype html>", page[:200].lower())
            self.assertIn("default-src 'none'", headers["Content-Security-Policy"])
            self.assertEqual(viewed.request(path="/")[0], 403)
            self.assertEqual(viewed.request(path="/?token=0")[0], 403)
            self.assertEqual(viewed.request(path="/etc/passwd")[0], 404)
            self.assertEqual(viewed.request("POST")[0], 405)
            self.assertEqual(viewed.request(Host="evil.example")[0], 403)
            for headers in ({"Origin": "http://evil.example"}, {"Host": "evil.example"}):
                with self.assertRaises(Refused):
                    viewed.client(**headers)
            with self.assertRaises(Refused):
                WebSocket(viewed.url.split("token=")[0] + "token=0")
            self.assertIn("--serve-control", viewed.client().ask("branch", line=0, time=0, interventions=[])["error"])

    def test_malformed_frames_and_requests_end_no_more_than_their_connection(self):
        chance = random.Random(2)
        with Viewed(*PART, "--until", "5") as viewed:
            viewed.wait_for_end_of_run()
            for _ in range(40):
                client = viewed.client()
                client.socket.sendall(chance.randbytes(chance.randrange(1, 300)))
                client.close()
            client = viewed.client()
            for text in ("", "{", "[]", "3", '"x"', '{"ask":3}', '{"ask":"seek"}', '{"ask":"seek","line":"x","time":1}',
                         '{"ask":"seek","line":99,"time":1}', '{"ask":"seek","line":0,"time":1e300}', '{"ask":"nothing"}',
                         '{"ask":"events","line":0,"from":-1,"to":1e18}', '{"ask":"plot","line":0,"robot":7}',
                         '{"ask":"stack","line":0,"event":-1}', '{"ask":"modules","line":0,"robot":99}', "\0" * 100):
                client.send(text.encode())
            client.send(b"still there?", PING)
            self.assertEqual(client.ask("header")["scenario"], "office")
            self.assertEqual(client.ask("seek", line=0, time=3 * SECOND)["time"], 3 * SECOND)
            with self.assertRaises((ConnectionError, OSError)):
                client.send(b" " * 100_000)
                client.ask("header")
            self.assertEqual(viewed.client().ask("header")["scenario"], "office")
            client = viewed.client()
            client.send(b"\x03\xe8", CLOSE)
            self.assertEqual(viewed.end(), 0, viewed.errors)

    def test_requests_that_are_none_are_refused_and_reach_no_run(self):
        chance = random.Random(3)
        known = {"header": {}, "follow": {"on": True, "rate": 30, "view": [0, 0, 9, 9], "scans": True, "robot": 0},
                 "seek": {"line": 0, "time": SECOND}, "step": {"line": 0, "count": 1, "task": 2}, "tasks": {"line": 0},
                 "modules": {"line": 0, "robot": 0}, "journal": {"line": 0}, "counts": {"line": 0},
                 "events": {"line": 0, "from": 0, "to": SECOND // 100, "most": 10}, "stack": {"line": 0, "event": 99},
                 "plot": {"line": 0, "robot": 0, "poster": "pom.position", "field": "position.pose.x", "from": 0,
                          "to": SECOND, "points": 3},
                 "digests": {"line": 0, "from": 0, "times": [SECOND]}, "compare": {"line": 0, "with": 1},
                 "branch": {"line": 0, "time": SECOND, "interventions": []}, "pause": {"on": False}, "speed": {"value": 0}}
        deep = []
        for _ in range(2000):
            deep = [deep]
        strange = ["x", "", -1, -SECOND, 2**63, 2**64 - 1, 1e300, -1e300, 0.5, None, True, [], {}, [[]], ["x"], [1, 2], {"a": []},
                   "\ud800", "a" * 5000, deep, [None] * 4, 99, SECOND * 10**9]
        plain = run(*PART, "--until", "3")
        sys.setrecursionlimit(10_000)
        with Viewed(*PART, "--until", "3", "--speed", "3", "--serve-control") as viewed:
            client = viewed.client()
            client.receive_until(lambda pushed: pushed.get("kind") == "status" and pushed["time"] > SECOND)
            for number in range(1, 250):
                what = chance.choice(list(known))
                request = {"id": number, "ask": what, **known[what]}
                for key in chance.sample(list(request), chance.choice((1, 1, 2))):
                    if chance.random() < 0.2 and key != "id":
                        del request[key]
                    else:
                        request[key] = chance.choice(strange)
                if what == "pause" and request.get("on") is True:
                    continue  # it would wait for ever
                client.send(json.dumps(request).encode())
                client.receive_until(lambda pushed: "id" in pushed)
            client.ask("speed", value=0)
            viewed.wait_for_end_of_run()
            self.assertEqual(client.ask("seek", line=0, time=2 * SECOND)["time"], 2 * SECOND)
            client.send(json.dumps({"ask": "seek", "line": 0, "time": deep}).encode())
            self.assertIn("few levels", client.receive_until(lambda pushed: "id" in pushed)["error"])
            self.assertIn("whole number", client.ask("modules", line=0, robot=99)["error"])
            self.assertEqual(viewed.end(), 0, viewed.errors)
        self.assertEqual(digest_in(viewed.output), digest_in(plain.stdout))
        self.assertEqual(viewed.processes(), [])

    def test_mistakes_in_the_options_are_one_line(self):
        with Viewed(*PART, "--until", "2") as viewed:
            for options in (("--serve", "127.0.0.1:x"), ("--serve", "nowhere:1"), ("--serve", urlsplit(viewed.url).netloc),
                            ("--serve-control",), ("--serve", "--seeds", "1..2"), ("--serve", "--verify")):
                done = run(*PART, "--until", "1", *options)
                self.assertEqual((done.returncode, done.stdout), (2, ""), options)
                self.assertRegex(done.stderr, r"^[^\n]*--serve[^\n]*\n$")

    def test_the_status_is_that_of_the_run_and_its_death_can_be_looked_at(self):
        with Viewed("--until", "20") as viewed:
            viewed.wait_for_end_of_run()
            self.assertEqual(viewed.end(), 1)
        with Viewed("--speed", "10") as viewed:
            client = viewed.client()
            while not (status := client.receive()).get("events"):
                pass
            children = subprocess.run(["pgrep", "-P", str(viewed.process.pid)], capture_output=True, text=True).stdout
            os.kill(int(children.split()[0]), signal.SIGKILL)
            viewed.wait_for_end_of_run()
            self.assertEqual(client.ask("seek", line=0, time=0)["time"], 0)
            pushed = [each for each in client.pushed if each.get("over")]
            while not (pushed or status.get("over")):
                status = client.receive()
            status = (pushed or [status])[0]
            self.assertEqual(status["outcome"], "crashed")
            self.assertEqual(viewed.end(), 128 + signal.SIGKILL)


if __name__ == "__main__":
    main()
