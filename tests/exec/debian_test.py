# SPDX-License-Identifier: BSD-3-Clause
"""Programs of Debian, unmodified, run by `waitpoint exec`: debian_test.py BUILD [--long].

Their output must equal the native one; equal seeds give equal runs, others different ones. With --long: 50 MB of input and
100 runs each.
"""

import hashlib
import os
import random
import shutil
import subprocess
import sys
import unittest

from exec_case import ExecCase, HERE, Summary, WAITPOINT, execute

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

REDIS = """
redis-server --port 0 --unixsocket socket --save '' > /dev/null & server=$!
until redis-cli -s socket ping > /dev/null 2>&1; do sleep 0.1; done
redis-benchmark -s socket -n 1000 -c 10 -t set,get,incr,lpush -q > /dev/null
redis-cli -s socket dbsize; redis-cli -s socket get counter:__rand_int__
redis-cli -s socket shutdown nosave; wait $server; echo $?
"""

GIT = """
export GIT_CONFIG_GLOBAL=/dev/null GIT_AUTHOR_DATE='2024-01-01 00:00:00 +0000' GIT_COMMITTER_DATE='2024-01-01 00:00:00 +0000'
export GIT_AUTHOR_NAME=a GIT_AUTHOR_EMAIL=a@b GIT_COMMITTER_NAME=a GIT_COMMITTER_EMAIL=a@b
git init -q .; for i in 1 2 3 4 5; do echo $i > file$i; git add .; git commit -qm $i; done
git gc -q; git fsck; git count-objects; git clone -q "file://$PWD" clone; git -C clone log --format=%H | cat
"""

MAKE = """
for i in 1 2 3 4; do echo "int f$i(int x) { return x * $i; }" > f$i.c; done
echo 'int f1(int), f2(int), f3(int), f4(int); int main(void) { return f1(1) + f2(1) + f3(1) + f4(1); }' > main.c
printf 'parts = main.o f1.o f2.o f3.o f4.o\nprogram: $(parts)\n\tgcc -o $@ $^\n%%.o: %%.c\n\tgcc -c -o $@ $<\n' > Makefile
make -s -j4; ./program; echo $?
"""

PERL_PROCESSES = r"""
open(my $lines, "-|", "echo a; sleep 1; echo b") or die; print while <$lines>; close $lines;
my $child = fork; if (!$child) { exit 3 } waitpid $child, 0; print $? >> 8, "\n"; system "exit 4"; print $? >> 8, `echo c`, time - $^T, "\n";
"""

SHELLS = """
for shell in dash bash; do $shell -c 'for i in 3 1 2; do (sleep 0.$i; echo $i) & done; wait; (exit 4); echo $?; timeout 1 sleep 9; echo $?
cat <<END | while read line; do echo "<$line>"; done
one
END'; done
mkfifo pipe; (seq 3; sleep 1; seq 3) > pipe & sort pipe; seq 20 | xargs -P4 -n1 sh -c 'sleep 0.0$0; echo $0' | sort -n | tail -1
"""

SOCAT = """
socat UNIX-LISTEN:socket,fork EXEC:'tr a-z A-Z' & server=$!; sleep 0.1
for word in one two; do echo $word | socat - UNIX-CONNECT:socket; done; kill $server; wait
"""

SERVER = """
python3 -m http.server 0 --bind 127.0.0.1 > log 2>&1 & server=$!
until grep -q port log; do sleep 0.1; done; port=$(sed 's/.* port \\([0-9]*\\).*/\\1/' log)
for i in 1 2 3; do curl -s http://127.0.0.1:$port/log | wc -l; done; kill $server; wait; echo end
"""


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
        """The output equals the native one; the run depends on the seed alone; four threads at once, and many switches."""
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
    """Programs of several processes: their output equals the native one, and the run depends on the seed alone."""

    def check_script(self, script, *needed):
        for program in needed:
            if not shutil.which(program):
                self.skipTest(f"there is no {program}")

        def run(*words):
            # In a folder of the same name, as its files are read and their names are printed.
            folder = self.folder / "script"
            folder.mkdir()
            done = subprocess.run([*words, "sh", "-c", script], cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, timeout=300)
            shutil.rmtree(folder)
            return done.returncode, done.stdout, done.stderr.decode(errors="replace")

        expected = run()[:2]
        digests = []
        for seed in [1] * RUNS_OF_A_SEED + [2]:
            *result, text = run(str(WAITPOINT), "exec", "--seed", str(seed), "--")
            self.assertEqual(tuple(result), expected, f"seed {seed}: {text}")
            digests.append(Summary(text).digest)
        self.assertEqual(len(set(digests[:-1])), 1, "a seed came to several runs")

    def test_redis_and_its_benchmark(self):
        self.check_script(REDIS, "redis-server", "redis-benchmark")

    def test_git(self):
        self.check_script(GIT, "git")

    def test_make_and_compilers(self):
        self.check_script(MAKE, "make", "gcc")

    def test_tar_and_a_compressor_with_threads(self):
        self.check_script(f"tar c -C {HERE} . | zstd -q -T4 -B65536 | zstd -q -d | tar t | sort | wc -l", "zstd")

    def test_shells(self):
        self.check_script(SHELLS, "bash")

    def test_perl(self):
        self.check_script(f"perl -e '{PERL_PROCESSES}'", "perl")

    def test_socat(self):
        self.check_script(SOCAT, "socat")

    def test_a_server_in_python_and_curl(self):
        self.check_script(SERVER, "curl")

    @unittest.skipUnless(os.path.exists(PYTHON), "there is no Python of the system")
    def test_python_processes_share_locks_queues_and_pools(self):
        for seed in range(1, 4):
            status, output, text = execute(seed, PYTHON, "-c", MULTIPROCESSING_PROGRAM)
            self.assertEqual((0, hashlib.sha256(b"400 4950 2646700 0\n").hexdigest()), (status, output), text)


class Clocks(Exec):
    """The cost of a program's code, by --clock."""

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


if __name__ == "__main__":
    unittest.main()
