# SPDX-License-Identifier: BSD-3-Clause
"""A run that is viewed, for tests: it ends with their block."""

import http.client
import re
import signal
import subprocess
import time
from urllib.parse import urlsplit

from installed import BUILD
from web_socket import WebSocket

WAITPOINT = BUILD / "tools/waitpoint"
OFFICE = BUILD.parent / "scenarios/office.yaml"
PATIENCE_S = 120
SECOND = 1_000_000_000
PART = ("--set", "expect={}")  # of the round: no goal is expected


def run(*options, scenario=OFFICE):
    return subprocess.run([WAITPOINT, "run", scenario, *options], capture_output=True, text=True, timeout=PATIENCE_S)


def digest_in(text):
    return re.search(r"digest +(wp1:\w+)", text)[1]


class Viewed:
    """A run that is viewed, until the end of the block."""

    def __init__(self, *options, scenario=OFFICE):
        self.process = subprocess.Popen([WAITPOINT, "run", scenario, "--serve", *options], stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE, text=True, start_new_session=True)
        self.url = re.search(r"http://\S+", self.process.stderr.readline())[0]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.end()

    def wait_for_end_of_run(self):
        for line in self.process.stderr:
            if "the run is over" in line:
                return

    def client(self, **headers):
        return WebSocket(self.url, **headers)

    def request(self, method="GET", path=None, **headers):
        address = urlsplit(self.url)
        connection = http.client.HTTPConnection(address.netloc, timeout=PATIENCE_S)
        connection.request(method, path if path is not None else f"/?{address.query}", headers=headers)
        answer = connection.getresponse()
        return answer.status, answer.read().decode(), dict(answer.getheaders())

    def processes(self):
        """Those of the run that are left, soon after its end."""
        for _ in range(100):
            left = subprocess.run(["pgrep", "-s", str(self.process.pid)], capture_output=True, text=True).stdout.split()
            if not left:
                break
            time.sleep(0.05)
        return left

    def end(self):
        """Returns the status of the run."""
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
        self.output, self.errors = self.process.communicate(timeout=PATIENCE_S)
        return self.process.returncode
