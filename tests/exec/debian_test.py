# SPDX-License-Identifier: BSD-3-Clause
"""Programs of Debian, unmodified, run by `waitpoint exec`: debian_test.py BUILD [--long].

Their output is the native one, a seed is one run, another seed another. With --long, on 50 MB and a hundred runs each.
"""

import functools
import hashlib
import json
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import time
import unittest

from exec_case import ExecCase, WAITPOINT

LONG = "--long" in sys.argv and not sys.argv.remove("--long")
INPUT_BYTES = 50_000_000 if LONG else 3_000_000
RUNS_OF_A_SEED = 100 if LONG else 3
PYTHON = "/usr/bin/python3"

QUEUE_PROGRAM = """
import queue, threading, time
letters, taken, lock = queue.Queue(5), [], threading.Lock()
def produce(who):
    for i in range(200): letters.put((who, i))
def consume():
    while (letter := letters.get()) is not None:
        with lock: taken.append(letter)
        if len(taken) % 50 == 0: time.sleep(0.01)
producers = [threading.Thread(target=produce, args=(i,)) for i in range(3)]
consumers = [threading.Thread(target=consume) for _ in range(3)]
for thread in producers + consumers: thread.start()
for thread in producers: thread.join()
for _ in consumers: letters.put(None)
for thread in consumers: thread.join()
print(sorted(taken) == [(who, i) for who in range(3) for i in range(200)], len(taken))
"""

MULTIPROCESSING_PROGRAM = """
import multiprocessing as processes
def count(lock, number):
    for _ in range(100):
        with lock: number.value += 1
def produce(queue):
    for i in range(100): queue.put(i)
    queue.put(None)
def wait(event, barrier): event.wait(); barrier.wait()
def square(x): return x * x
if __name__ == '__main__':
    lock, number = processes.Lock(), processes.Value('i', 0, lock=False)
    workers = [processes.Process(target=count, args=(lock, number)) for _ in range(4)]
    for worker in workers: worker.start()
    for worker in workers: worker.join()
    queue = processes.Queue(3)
    producer = processes.Process(target=produce, args=(queue,)); producer.start()
    total = sum(iter(queue.get, None)); producer.join()
    event, barrier = processes.Event(), processes.Barrier(2)
    other = processes.Process(target=wait, args=(event, barrier)); other.start()
    event.set(); barrier.wait(); other.join()
    with processes.Pool(3) as pool: squares = sum(pool.map(square, range(200)))
    print(number.value, total, squares, other.exitcode)
"""

ASYNCIO_PROGRAM = """
import asyncio, threading, time
async def serve(reader, writer):
    line = await reader.readline()
    await asyncio.sleep(0.5)
    writer.write(line.upper()); await writer.drain(); writer.close()
async def ask(port, number):
    reader, writer = await asyncio.open_connection('127.0.0.1', port)
    writer.write(b'hello %d\\n' % number); await writer.drain()
    line = await reader.readline(); writer.close()
    return line
def work(number):
    for _ in range(100): time.sleep(0.001)
    return number
async def main():
    server = await asyncio.start_server(serve, '127.0.0.1', 0)
    port = server.sockets[0].getsockname()[1]
    loop = asyncio.get_running_loop()
    print(await asyncio.gather(*[ask(port, i) for i in range(20)]))
    print(await asyncio.gather(*[loop.run_in_executor(None, work, i) for i in range(8)]))
asyncio.run(main())
"""

PERL_PROGRAM = """
use threads; use threads::shared; use Thread::Queue;
my $queue = Thread::Queue->new(); my $sum :shared = 0;
my @threads = map { threads->create(sub { while (defined(my $x = $queue->dequeue())) { lock($sum); $sum += $x; } }) } 1 .. 4;
$queue->enqueue($_) for 1 .. 500; $queue->end(); $_->join() for @threads; print "sum $sum\\n";
"""


class Summary:
    """The line about a run."""

    def __init__(self, text):
        found = re.search(r"waitpoint: (\S+): (\d+) threads, (\d+) at once, (\d+) events, (\d+) switches, "
                          r"([0-9.]+) s of virtual time, digest (wp1:[0-9a-f]{16})", text)
        if not found:
            raise AssertionError(f"no line about the run in: {text}")
        self.at_once, self.switches = int(found[3]), int(found[5])
        self.seconds, self.digest = float(found[6]), found[7]


def execute(seed, *command, stdin=None):
    """Returns the exit status, a hash of standard output, and what was said on the error stream."""
    words = [WAITPOINT, "exec", "--seed", seed, "--", *command]
    done = subprocess.run([str(word) for word in words], stdin=stdin, capture_output=True, timeout=300)
    return done.returncode, hashlib.sha256(done.stdout).hexdigest(), done.stderr.decode(errors="replace")


def native(*command):
    done = subprocess.run([str(word) for word in command], stdin=subprocess.DEVNULL, capture_output=True, timeout=300)
    return done.returncode, hashlib.sha256(done.stdout).hexdigest()


class Exec(ExecCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        if hasattr(Exec, "bytes"):
            return
        Exec.bytes = cls.folder / "bytes"
        Exec.lines = cls.folder / "lines"
        draws = random.Random(1)
        words = [draws.randbytes(draws.randrange(2, 40)) for _ in range(2000)]
        with cls.bytes.open("wb") as file:
            while file.tell() < INPUT_BYTES:
                file.write(b"".join(draws.choices(words, k=1000)))
        with cls.lines.open("w") as file:
            while file.tell() < INPUT_BYTES:
                file.write("".join(f"{draws.randrange(10**7)}\n" for _ in range(1000)))

    def check(self, *command, switches=1000):
        """As native; one seed is one run, another one another; with four threads at once, and many switches."""
        if not shutil.which(str(command[0])):
            self.skipTest(f"there is no {command[0]}")
        expected = native(*command)
        digests = []
        for seed in [1] * RUNS_OF_A_SEED + [2, 3]:
            status, output, text = execute(seed, *command, stdin=subprocess.DEVNULL)
            self.assertEqual((status, output), expected, f"seed {seed}: {text}")
            summary = Summary(text)
            self.assertGreaterEqual(summary.at_once, 4)
            if LONG:
                self.assertGreaterEqual(summary.switches, switches)
            digests.append(summary.digest)
        self.assertEqual(len(set(digests[:-2])), 1, "a seed came to several runs")
        self.assertEqual(len(set(digests[-3:])), 3, "seeds came to the same run")
        if LONG:
            print(f"{command[0]}: {summary.at_once} threads at once, {summary.switches} switches, {len(digests)} runs", file=sys.stderr)


class Programs(Exec):
    def test_zstd(self):
        self.check("zstd", "-T4", "-B131072" if LONG else "-B65536", "-c", self.bytes)

    def test_xz(self):
        self.check("xz", "-T4", "-0", "--block-size=16384", "-c", self.bytes)

    def test_pigz(self):
        self.check("pigz", "-p4", "-c", self.bytes)

    def test_pbzip2(self):
        self.check("pbzip2", "-p4", "-b1", "-c", self.bytes)

    def test_sort(self):
        self.check("sort", "--parallel=4", "-S200M", self.lines)

    def test_python_with_threads_and_a_queue(self):
        self.check(PYTHON, "-c", QUEUE_PROGRAM)

    def test_python_with_asyncio(self):
        self.check(PYTHON, "-c", ASYNCIO_PROGRAM)

    def test_perl_with_threads(self):
        self.check("perl", "-e", PERL_PROGRAM)

    def test_a_program_with_tbb(self):
        self.check(self.compile("tbb_program.cpp", "-ltbb"))

    def test_a_program_with_libuv(self):
        self.check(self.compile("uv_program.c", "-luv"))


class Processes(Exec):
    """Children of a program: when they do what is not of the seed."""

    @unittest.skipUnless(os.path.exists(PYTHON), "there is no Python of the system")
    def test_of_python_share_locks_queues_and_pools(self):
        for seed in range(1, 4):
            status, output, text = execute(seed, PYTHON, "-c", MULTIPROCESSING_PROGRAM)
            self.assertEqual((0, hashlib.sha256(b"400 4950 2646700 0\n").hexdigest()), (status, output), text)


class Ends(Exec):
    """However a program ends, its exit status is its own, and what it came to is told."""

    def end(self, way):
        return execute(1, self.compile("ends.c"), way)

    def test_by_exit_of_any_thread(self):
        for way, expected in (("", 7), ("exit", 3), ("_exit", 4), ("main leaves", 0)):
            status, _, text = self.end(way)
            self.assertEqual(status, expected, way)
            self.assertGreaterEqual(Summary(text).seconds, 2)
            self.assertEqual("waitpoint: replay: waitpoint exec --seed 1 --" in text, status != 0, text)

    def test_by_a_signal(self):
        for way, expected in (("abort", -6), ("crash", -11), ("kill", -9), ("overflow", -11)):
            status, _, text = self.end(way)
            self.assertEqual(status, expected, way)
            self.assertGreaterEqual(Summary(text).seconds, 2, "not known up to its last event")
            self.assertIn(f"it was ended by signal {-expected}", text)
            self.assertRegex(text, r"replay: waitpoint exec --seed 1 -- \S+ends ")

    def test_by_a_signal_that_is_sent_to_waitpoint_alone(self):
        for sent in (signal.SIGINT, signal.SIGQUIT, signal.SIGTERM):
            words = [str(word) for word in (WAITPOINT, "exec", "--", "cat")]
            # Who runs the tests may have these ignored, as a shell does for what it runs in the background.
            heed = functools.partial(signal.signal, sent, signal.SIG_DFL)
            with subprocess.Popen(
                words, stdin=subprocess.PIPE, stderr=subprocess.DEVNULL, preexec_fn=heed
            ) as running:
                time.sleep(0.5)
                running.send_signal(sent)
                self.assertEqual(running.wait(20), -sent)

    def test_by_a_deadlock_that_is_explained(self):
        status, _, text = self.end("deadlock")
        self.assertEqual(status, 124)
        self.assertIn("deadlock at 4.", text)
        self.assertIn("main waits for mutex right, held by thread 1\n", text)
        self.assertIn("thread 1 waits for mutex left, held by main\n", text)
        self.assertIn("replay: waitpoint exec --seed 1 --", text)

    def test_as_it_would_while_some_wait_for_each_other(self):
        status, _, text = self.end("cycle")
        self.assertEqual(status, 5, text)
        self.assertIn("deadlock at 4.000000000 s of virtual time, of some: the others go on\n"
                      "  thread 2 waits for mutex right, held by thread 1\n"
                      "  thread 1 waits for mutex left, held by thread 2\n", text)
        self.assertEqual(text.count("waits for"), 2)


class Clocks(Exec):
    """What a program's code costs, if it is to cost anything."""

    def seconds(self, *options):
        words = [WAITPOINT, "exec", *options, "--", "zstd", "-T4", "-q", "-c", self.folder / "short"]
        done = subprocess.run([str(word) for word in words], capture_output=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return Summary(done.stderr.decode())

    def test_move_virtual_time(self):
        if not shutil.which("zstd"):
            self.skipTest("there is no zstd")
        (self.folder / "short").write_bytes(self.bytes.read_bytes()[:300_000])
        nothing, fixed = self.seconds(), self.seconds("--clock", "fixed:10")
        self.assertLess(nothing.seconds, 1e-3)
        self.assertGreater(fixed.seconds, 20 * 10e-6)
        drawn = [self.seconds("--clock", "interval:1..100", "--seed", seed) for seed in ("1", "1", "2")]
        self.assertEqual(drawn[0].digest, drawn[1].digest)
        self.assertNotEqual(drawn[0].digest, drawn[2].digest)
        measured = [self.seconds("--clock", clock).seconds for clock in ("cpu", "cpu:x100")]
        self.assertGreater(measured[0], 1e-4)
        self.assertGreater(measured[1], 10 * measured[0])


class Traces(Exec):
    def test_hold_what_happened_up_to_a_crash(self):
        for way, status in (("crash", -11), ("deadlock", 124)):
            trace = self.folder / "trace.json"
            done = subprocess.run([str(WAITPOINT), "exec", "--trace", str(trace), "--", str(self.compile("ends.c")), way],
                                  capture_output=True)
            self.assertEqual(done.returncode, status)
            events = json.loads(trace.read_text())["traceEvents"]
            threads = {event["args"]["name"] for event in events if event["name"] == "thread_name"}
            self.assertEqual(threads, {"main#0 of ends", "thread 1#1 of ends"})
            last = max(event["ts"] for event in events if "ts" in event)
            self.assertGreaterEqual(last, 2e6, "microseconds of virtual time")

class Options(Exec):
    """What a run does not share with the machine."""

    def output(self, what, *options, seed=1):
        words = [WAITPOINT, "exec", "--quiet", "--seed", seed, *options, "--", self.compile("options.c"), what]
        done = subprocess.run([str(word) for word in words], capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout.split(), done.stderr

    def test_the_trapped_counter_of_the_processor_shows_virtual_time(self):
        (between, slept, processor), _ = self.output("counter", "--trap-rdtsc")
        self.assertLess(int(between), 1000)
        self.assertTrue(1_000_000 <= int(slept) < 1_010_000, slept)
        self.assertEqual(processor, "0")
        self.assertEqual(self.output("counter", "--trap-rdtsc")[0], [between, slept, processor])

    def test_an_isolated_program_reaches_nothing_outside(self):
        found, told = self.output("connect", "--isolate")
        self.assertEqual(found, ["0", "1"])
        self.assertEqual(told, "waitpoint: exec: what leaves this machine is forbidden by --isolate\n")
        self.assertEqual(self.output("connect")[0][0], "0")

    def test_the_random_bytes_of_a_process_are_of_the_seed(self):
        self.assertEqual(self.output("random"), self.output("random"))
        for one, other in zip(self.output("random")[0], self.output("random", seed=2)[0]):
            self.assertNotEqual(one, other)

    def test_a_date_that_is_set_is_the_simulations_own(self):
        if os.geteuid() == 0:
            self.assertEqual(self.output("date")[0], ["1000000000"])
        self.assertLess(abs(time.time() - os.stat("/proc/self").st_ctime), 100)


class Deadlocks(Exec):
    """Waiting for a descriptor whose ends only the program has, and whom nobody else can do anything to."""

    def test_are_told_whatever_made_the_descriptor(self):
        program = self.compile("stuck.c")
        for way in "pipe", "pipe2", "socketpair", "eventfd", "dup", "dup2", "dup3", "fcntl", "epoll_create", "epoll_create1":
            status, _, text = execute(1, program, way)
            self.assertEqual(status, 124, f"{way}: {text}")
            self.assertIn("main waits for descriptor", text)

    def test_are_none_where_something_may_come_from_outside(self):
        done = subprocess.run([str(WAITPOINT), "exec", "--", str(self.compile("stuck.c")), "epoll of outside"],
                              input=b"x", capture_output=True, timeout=60)
        self.assertEqual(done.returncode, 1, done.stderr)


class Loopback(Exec):
    def test_is_no_matter_of_the_wall_clock(self):
        runs = [execute(seed, self.compile("loopback.c")) for seed in (1, 1, 1, 2)]
        for status, _, text in runs:
            self.assertEqual(status, 0, text)
            self.assertLess(Summary(text).seconds, 0.02)
        digests = [Summary(text).digest for _, _, text in runs]
        self.assertEqual((len(set(digests[:3])), len(set(digests))), (1, 2))


class Seeds(Exec):
    """A campaign ends at the first seed that fails, and says how to see it again."""

    def test_find_a_lost_update_without_compiling_the_program_anew(self):
        program = self.compile("lost_update.c")
        done = subprocess.run([str(WAITPOINT), "exec", "--seeds", "1..200", "--", str(program)], capture_output=True, text=True)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("an update was lost", done.stderr)
        seed = re.search(r"seed (\d+) failed, after \d+ that did not: exit status 1", done.stderr)[1]
        self.assertIn(f"replay: waitpoint exec --seed {seed} -- {program}", done.stderr)
        self.assertEqual(execute(seed, program)[0], 1)

    def test_that_all_end_well_are_counted_with_their_schedules(self):
        program = self.compile("lost_update.c")
        done = subprocess.run([str(WAITPOINT), "exec", "--seeds", "1..20", "--", str(program), "locked"],
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stderr, r"lost_update: 20 seeds, \d+ schedules, none failed")


class Refusals(Exec):
    def refused(self, *words):
        done = subprocess.run([str(WAITPOINT), "exec", *words], capture_output=True, text=True)
        self.assertEqual(done.returncode, 125)
        self.assertEqual(done.stdout, "")
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        return done.stderr

    def test_say_what_is_wrong(self):
        self.assertIn("there is no program 'nosuch'", self.refused("--", "nosuch"))
        self.assertIn("expected what to run", self.refused())
        self.assertIn("expected what to run", self.refused("--"))
        self.assertIn("--seed: expected a whole number from 0 to 2^64 - 1, found 'x'", self.refused("--seed", "x", "--", "true"))
        self.assertIn("--seeds: expected FIRST..LAST, found '5..1'", self.refused("--seeds", "5..1", "--", "true"))
        for clock in ("best", "fixed", "fixed:-1", "interval:5", "interval:5..1", "cpu:2", "cpu:x-1"):
            self.assertIn(f"--clock: expected fixed:US, interval:US..US, counted[:NS], cpu[:xFACTOR] or proportional[:xFACTOR], found '{clock}'",
                          self.refused("--clock", clock, "--", "true"))
        self.assertIn("--trace: cannot be used together with --seeds", self.refused("--seeds", "1..2", "--trace", "x", "--", "true"))
        self.assertIn("--strategy: expected random or fifo (waitpoint explore --exec has others), found 'best'", self.refused("--strategy", "best", "--", "true"))
        self.assertIn("unknown option '--sed', did you mean '--seed'?", self.refused("--sed", "1", "--", "true"))

    def test_of_programs_that_nothing_can_be_preloaded_into(self):
        static = self.folder / "static"
        (self.folder / "empty.c").write_text("int main(void) { return 0; }\n")
        for option in "-static-pie", "-static":
            subprocess.run(["gcc", option, self.folder / "empty.c", "-o", static], check=True)
            self.assertIn("is linked statically", self.refused("--", str(static)))
        static.chmod(0o4755)
        self.assertIn("changes its user or group", self.refused("--", str(static)))
        text = self.folder / "text"
        text.write_text("neither\n")
        text.chmod(0o755)
        self.assertIn("is neither a program nor a script", self.refused("--", str(text)))


if __name__ == "__main__":
    unittest.main()
