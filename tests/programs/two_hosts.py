# SPDX-License-Identifier: BSD-3-Clause
"""Two hosts on this one: name spaces of the network and of processes, and a wire between them that delays each packet."""

import collections
import fcntl
import os
import select
import shutil
import struct
import subprocess
import threading
import time
import unittest

TUNSETIFF, TUN_WITHOUT_HEADER = 0x400454CA, 0x1001


class Wire(threading.Thread):
    """Carries packets between two devices, which must be up; each takes `delay_s`."""

    def __init__(self, names, delay_s):
        super().__init__(daemon=True)
        self.delay_s, self.ended = delay_s, False
        self.ends = [os.open("/dev/net/tun", os.O_RDWR | os.O_CLOEXEC) for _ in names]
        for end, name in zip(self.ends, names):
            fcntl.ioctl(end, TUNSETIFF, struct.pack("16sH", name.encode(), TUN_WITHOUT_HEADER))

    def run(self):
        travelling = collections.deque()  # (time of arrival, end, packet)
        while not self.ended:
            wait_s = max(0, travelling[0][0] - time.monotonic()) if travelling else 0.1
            for end in select.select(self.ends, [], [], wait_s)[0]:
                other = self.ends[1 - self.ends.index(end)]
                travelling.append((time.monotonic() + self.delay_s, other, os.read(end, 65536)))
            while travelling and travelling[0][0] <= time.monotonic():
                _, end, packet = travelling.popleft()
                os.write(end, packet)

    def close(self):
        self.ended = True
        self.join()
        for end in self.ends:
            os.close(end)


class TwoHosts:
    """Context. Skips the test, with the reason, where the machine does not allow it."""

    ADDRESSES = ("10.77.0.1", "10.77.0.2")

    def __init__(self, folder, delay_s):
        self.names = [f"wp{os.getpid()}{end}" for end in "ab"]
        self.agent, self.delay_s, self.wire = folder / "agent.sh", delay_s, None

    def ip(self, *words):
        done = subprocess.run(["ip", *words], capture_output=True, text=True, timeout=60)
        if done.returncode != 0:
            raise unittest.SkipTest(f"no name spaces of the network here: {done.stderr.strip()}")

    def __enter__(self):
        if os.geteuid() != 0 or not os.access("/dev/net/tun", os.W_OK) or None in map(shutil.which, ("ip", "unshare", "hostname")):
            raise unittest.SkipTest("name spaces of the network need root's rights, iproute2, unshare, hostname and /dev/net/tun")
        try:
            self.make()
        except BaseException:
            self.__exit__()
            raise
        return self

    def make(self):
        for name in self.names:
            self.ip("netns", "add", name)
        try:
            self.wire = Wire(self.names, self.delay_s)
        except OSError as error:
            raise unittest.SkipTest(f"no wire between two hosts here: {error}") from error
        for name, own, other in zip(self.names, self.ADDRESSES, reversed(self.ADDRESSES)):
            self.ip("link", "set", name, "netns", name)
            self.ip("-n", name, "addr", "add", own, "peer", other, "dev", name)
            self.ip("-n", name, "link", "set", "lo", "up")
            self.ip("-n", name, "link", "set", name, "up")
        self.wire.start()
        # As ssh: the host's name, then a command line.
        self.agent.write_text(f"#!/bin/sh\nshift\nexec ip netns exec {self.names[1]} unshare --uts --pid --fork "
                              'sh -c "hostname far; $*"\n')
        self.agent.chmod(0o755)

    def launcher(self, mpirun, ranks):
        """A command that starts `ranks` processes, half of them on the far host."""
        hosts = f"{self.ADDRESSES[0]}:{ranks - ranks // 2},{self.ADDRESSES[1]}:{ranks // 2}"
        options = ["plm_rsh_agent", self.agent, "pml", "ob1", "btl", "tcp,self", "btl_tcp_if_exclude", "lo", "oob_tcp_if_exclude", "lo"]
        mca = [word for name, value in zip(options[::2], options[1::2]) for word in ("--mca", name, str(value))]
        return ["ip", "netns", "exec", self.names[0], "unshare", "--uts", "sh", "-c", 'hostname near; exec "$@"', "sh", *mpirun, *mca,
                "-n", str(ranks), "--host", hosts]

    def __exit__(self, *_):
        if self.wire is not None and self.wire.is_alive():
            self.wire.close()
        for name in self.names:
            subprocess.run(["ip", "netns", "del", name], capture_output=True, check=False, timeout=60)
