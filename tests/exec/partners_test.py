# SPDX-License-Identifier: BSD-3-Clause
"""Programs with partners outside of the simulation: partners_test.py BUILD.

Natives at the other end of a socket live in real time, so virtual time keeps pace with it.
"""

import pathlib
import socket
import subprocess
import tempfile
import threading
import time
import unittest

from exec_case import ExecCase, Summary, WAITPOINT

# Asks three times, a virtual half second apart; each answer comes within its timeout of 20 s, or "late" is printed.
CLIENT = """
import socket, sys, time
kind, where = sys.argv[1:3]
peer = socket.socket(socket.AF_UNIX) if kind == "unix" else socket.socket()
peer.connect(where if kind == "unix" else ("127.0.0.1", int(where)))
peer.settimeout(20)
begin = time.monotonic()
for i in range(3):
    peer.sendall(b"?")
    try: print("answer" if peer.recv(1) else "end")
    except socket.timeout: print("late")
    time.sleep(0.5)
print(round(time.monotonic() - begin, 2))
"""

# Counts the ticks of a tenth of a second until a client comes, and tells it the number.
SERVER = """
import socket, sys
listener = socket.create_server(("127.0.0.1", 0))
print(listener.getsockname()[1], flush=True)
listener.settimeout(0.1)
ticks = 0
while True:
    try:
        client, _ = listener.accept()
        break
    except socket.timeout: ticks += 1
client.sendall(str(ticks).encode())
"""

# Both ends inside: two hours pass at once.
BOTH = """
import socket, threading, time
listener = socket.create_server(("127.0.0.1", 0))
def ask():
    time.sleep(3600)
    peer = socket.create_connection(listener.getsockname())
    time.sleep(3600)
    peer.sendall(b"!")
threading.Thread(target=ask).start()
client, _ = listener.accept()
client.settimeout(7200)
print(client.recv(1), round(time.monotonic()) - 3600)
"""


class Partners(ExecCase):
    def answer_later(self, listener):
        """A native server that takes 0.3 s for each of three answers."""

        def answer():
            peer, _ = listener.accept()
            with peer:
                for _ in range(3):
                    if not peer.recv(1):
                        return
                    time.sleep(0.3)
                    peer.sendall(b"!")
                peer.recv(1)

        thread = threading.Thread(target=answer, daemon=True)
        thread.start()
        return thread

    def words(self, program, *arguments, options=()):
        name = self.folder / f"{hash(program)}.py"
        name.write_text(program)
        return [str(word) for word in (WAITPOINT, "exec", *options, "--", "/usr/bin/python3", name, *arguments)]

    def ask(self, kind, options=()):
        with tempfile.TemporaryDirectory() as folder:
            where = str(pathlib.Path(folder) / "socket")
            listener = socket.socket(socket.AF_UNIX) if kind == "unix" else socket.create_server(("127.0.0.1", 0))
            with listener:
                if kind == "unix":
                    listener.bind(where)
                    listener.listen()
                else:
                    where = str(listener.getsockname()[1])
                self.answer_later(listener)
                begin = time.monotonic()
                done = subprocess.run(self.words(CLIENT, kind, where, options=options), capture_output=True, text=True, timeout=120)
                self.assertEqual(done.returncode, 0, done.stderr)
                return done.stdout.split(), time.monotonic() - begin

    def test_a_native_server_answers_before_the_timeout_of_its_client(self):
        for kind in "unix", "internet":
            lines, _ = self.ask(kind)
            self.assertEqual(lines[:3], ["answer"] * 3)
            self.assertGreaterEqual(float(lines[3]), 2.0, "virtual time is not behind real time by much")

    def test_without_it_virtual_time_runs_ahead(self):
        lines, _ = self.ask("internet", ("--speed", "max"))
        self.assertIn("late", lines)

    def test_virtual_time_may_be_faster(self):
        lines, _ = self.ask("internet", ("--speed", "10"))
        self.assertEqual(lines[:3], ["answer"] * 3)
        self.assertGreaterEqual(float(lines[3]), 6, "0.3 s of the server's are 3 s")

    def test_a_server_lives_in_the_time_of_its_native_clients(self):
        with subprocess.Popen(self.words(SERVER), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as running:
            port = int(running.stdout.readline())
            time.sleep(1)
            with socket.create_connection(("127.0.0.1", port)) as peer:
                ticks = int(peer.recv(10))
            self.assertEqual(running.wait(30), 0)
        self.assertGreaterEqual(ticks, 5)
        self.assertLess(ticks, 1000)

    def test_a_run_ahead_of_its_input_is_reported(self):
        program = "import sys, threading, time\nthreading.Thread(target=sys.stdin.readline).start()\nfor i in range(50): time.sleep(1)"
        with subprocess.Popen(self.words(program), stdin=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as running:
            line = running.stderr.readline()
            running.communicate("\n", timeout=60)
            self.assertEqual(running.returncode, 0)
        self.assertRegex(line, r"waitpoint: virtual time is ahead of real time by \d+\.\d s while a thread waits for input from outside\n")

    def test_ends_inside_are_no_partners(self):
        done = subprocess.run(self.words(BOTH), capture_output=True, text=True, timeout=60)
        self.assertEqual(done.stdout, "b'!' 7200\n", done.stderr)

    def test_speeds_that_are_none_are_refused(self):
        done = subprocess.run(self.words(BOTH, options=("--speed", "-1")), capture_output=True, text=True)
        self.assertEqual(done.returncode, 125)
        self.assertEqual(done.stderr, "waitpoint: --speed: expected max or a number from 0.000001 to 1000000, found '-1'\n")


if __name__ == "__main__":
    unittest.main()
