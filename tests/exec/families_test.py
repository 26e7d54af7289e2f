# SPDX-License-Identifier: BSD-3-Clause
"""Programs of several processes, but shells, in one simulation: families_test.py BUILD.

Their output is as natively; equal seeds give equal runs, with one digest for all processes.
"""

import os
import pathlib
import re
import subprocess
import tempfile
import unittest

from exec_case import BUILD
from family_case import Families, PYTHON, Run

SPAWN_PROGRAM = """
import multiprocessing, os, sys, time
def work(queue, number):
    time.sleep(0.1 * (4 - number))
    queue.put((number, os.getppid()))
if __name__ == "__main__":
    multiprocessing.set_start_method(sys.argv[1])
    queue = multiprocessing.Queue()
    processes = [multiprocessing.Process(target=work, args=(queue, i)) for i in range(4)]
    for process in processes: process.start()
    print([queue.get()[0] for _ in processes])
    for process in processes: process.join()
    print([process.exitcode for process in processes], time.monotonic() < 3601)
"""

DEADLOCK = """
import multiprocessing
a, b = multiprocessing.Lock(), multiprocessing.Lock()
ready = multiprocessing.Barrier(2)
def take(first, second):
    with first:
        ready.wait()
        with second: pass
if __name__ == "__main__":
    other = multiprocessing.Process(target=take, args=(a, b))
    other.start()
    take(b, a)
"""

KILLED_CHILD = """
import asyncio
async def main():
    child = await asyncio.create_subprocess_exec("sleep", "100")
    try: await asyncio.wait_for(child.wait(), 1)
    except asyncio.TimeoutError: child.kill(); print("timeout", await child.wait())
asyncio.run(main())
"""

# A relay between two processes, which waits by epoll: for input, for room, at a duplicate, at a descriptor that is
# watched anew under the number of a closed one.
RELAY = """
import os, select, socket
listening = socket.create_server(("127.0.0.1", 0))
address = listening.getsockname()
if os.fork() == 0:  # sends more than there is room for, and closes
    with socket.create_connection(address) as out: out.sendall(bytes(range(256)) * 4000)
    with socket.create_connection(address) as out: out.sendall(b"end")
    os._exit(0)
back = socket.create_server(("127.0.0.1", 0))
if os.fork() == 0:  # reads slowly
    with socket.create_connection(back.getsockname()) as into:
        count = 0
        while more := into.recv(5000): count += len(more)
    print("received", count, flush=True)
    os._exit(0)
out, _ = back.accept()
out.setblocking(False)
waiting, taken, held = select.epoll(), 0, b""
waiting.register(listening, select.EPOLLIN)
duplicate = select.epoll.fromfd(os.dup(waiting.fileno()))
connections, order = {}, []
while taken < 2:
    for number, event in duplicate.poll():
        if number == listening.fileno():
            made, _ = listening.accept()
            connections[made.fileno()] = made
            waiting.register(made, select.EPOLLIN)
        elif number == out.fileno():
            held = held[out.send(held):]
            if not held:
                duplicate.unregister(out)
                for each in connections: waiting.modify(each, select.EPOLLIN)
        elif data := connections[number].recv(30000):
            if not held: waiting.register(out, select.EPOLLOUT)
            held += data
            for each in connections: duplicate.modify(each, 0)
        else:
            connections.pop(number).close()
            taken += 1
out.close()
for _ in range(2): os.wait()
print("relayed")
"""

# A thread waits at an epoll descriptor, to which another thread adds a connection meanwhile.
WATCHED_LATER = """
import os, select, socket, threading, time
listening = socket.create_server(("127.0.0.1", 0))
if os.fork() == 0:
    with socket.create_connection(listening.getsockname()) as out:
        time.sleep(2)
        out.sendall(b"late")
        time.sleep(2)
    os._exit(0)
waiting = select.epoll()
waiting.register(os.pipe()[0], select.EPOLLIN)
found = []
thread = threading.Thread(target=lambda: found.append((waiting.poll(10), time.monotonic())))
begin = time.monotonic()
thread.start()
made, _ = listening.accept()
time.sleep(1)
waiting.register(made, select.EPOLLIN)
thread.join()
print(found[0][0] == [(made.fileno(), select.EPOLLIN)], round(found[0][1] - begin, 2))
"""

PASSED_PIPE = """
import os, socket, time
ours, theirs = socket.socketpair()
if os.fork() == 0:
    reader, writer = os.pipe()
    time.sleep(0.5)
    socket.send_fds(theirs, [b"x"], [reader])
    time.sleep(0.5)
    os.write(writer, b"sent")
    os._exit(0)
_, descriptors, _, _ = socket.recv_fds(ours, 9, 1)
print(os.read(descriptors[0], 9))
os.wait()
"""

# The server waits for its client several times at one instant.
BYTE_BY_BYTE = """
import os, socket, time
for family, name in (socket.AF_UNIX, "\\0bytes" + str(os.getpid())), (socket.AF_INET, ("127.0.0.1", 0)):
    listener = socket.socket(family)
    listener.bind(name)
    listener.listen()
    if os.fork() == 0:
        connection, _ = listener.accept()
        text = b""
        while not text.endswith(b"\\n"): text += connection.recv(1)
        connection.sendall(text.upper())
        os._exit(0)
    client = socket.socket(family)
    client.connect(listener.getsockname())
    client.settimeout(0.5)
    begin = time.monotonic()
    client.sendall(b"request\\n")
    print(client.recv(100))
    os.wait()
"""


class Programs(Families):
    def test_multiprocessing_by_each_way_of_starting(self):
        with tempfile.TemporaryDirectory() as folder:
            program = pathlib.Path(folder) / "program.py"
            program.write_text(SPAWN_PROGRAM)
            for way in "fork", "spawn", "forkserver":
                for run in self.assertRepeats(PYTHON, program, way, seeds=[1, 2]):
                    self.assertEqual(run.output, "[3, 2, 1, 0]\n[0, 0, 0, 0] True\n", run.errors)

    def test_make_with_jobs(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            rules = "".join(f"part{i}: ; @echo {i} > $@; sleep 0.{i}\n" for i in range(1, 9))
            names = " ".join(f"part{i}" for i in range(1, 9))
            (folder / "Makefile").write_text(f"all: {names}\n\t@cat $^ > all; cat all\n{rules}")

            def clean():
                for file in folder.iterdir():
                    if file.name != "Makefile":
                        file.unlink()

            digests = set()
            for _ in range(2):
                run = Run(1, "make", "-s", "-j4", cwd=folder)
                self.assertEqual(run.output.split(), [str(i) for i in range(1, 9)], run.errors)
                digests.add(run.digest)
                clean()
            self.assertEqual(len(digests), 1)

    def test_a_deadlock_across_processes_is_reported(self):
        with tempfile.TemporaryDirectory() as folder:
            program = pathlib.Path(folder) / "program.py"
            program.write_text(DEADLOCK)
            run = Run(1, PYTHON, program)
            self.assertEqual(run.status, 124, run.errors)
            self.assertEqual(run.errors.count("waitpoint: deadlock at"), 1, run.errors)
            self.assertEqual(len(re.findall(r"^  \S+: main waits for", run.errors, re.M)), 2, run.errors)

    def test_a_server_that_reads_byte_by_byte_answers_at_once(self):
        with tempfile.TemporaryDirectory() as folder:
            program = pathlib.Path(folder) / "program.py"
            program.write_text(BYTE_BY_BYTE)
            self.assertNative(PYTHON, program)

    def test_streams_of_the_c_library_over_sockets(self):
        run = self.assertNative(self.compile("socket_stream.c"))[0]
        self.assertEqual(run.output, "7\n14\n21\n")

    def test_instrumented_programs_behind_scripts_and_beside_others(self):
        if not (BUILD / "libwaitpoint-exec-races.so").exists():
            self.skipTest("this build has no runtime for -fsanitize=thread")
        racing = self.compile("racing.cpp", "-g", "-fsanitize=thread")
        race = (r"data race at 0x\w+ .*\n  first: write of 4 bytes by task thread [12]#[12], after its event \d+\n"
                r"    .* at .*racing\.cpp:20\n(    .*\n)*  second: read of 4 bytes by task thread [12]#[12], ")
        script = f"{racing}; echo $?; exec {racing} locked"
        for run in self.assertRepeats("sh", "-c", script):
            self.assertEqual((run.status, run.output), (0, "2 seen\n0\n2 seen\n"), run.errors)
            self.assertRegex(run.errors, r"data races of racing#\d+:\n" + race)
            self.assertEqual(run.errors.count("data races of"), 1, run.errors)
        for run in self.assertRepeats(racing, "locked", "::", "one=" + str(racing)):
            self.assertEqual((run.status, run.output), (0, "2 seen\n2 seen\n"), run.errors)
            self.assertRegex(run.errors, r"data races of one:\n" + race)
            self.assertEqual(run.errors.count("data races of"), 1, run.errors)

    def test_programs_started_by_instrumented_ones(self):
        if not (BUILD / "libwaitpoint-exec-races.so").exists():
            self.skipTest("this build has no runtime for -fsanitize=thread")
        source = """
            #include <cstdio>
            #include <cstdlib>
            #include <thread>
            int main(int argc, char** argv) {
              int status = 1;
              std::thread([&] {
                const char* const command = argc > 1 ? argv[1] : "echo ${LD_LIBRARY_PATH-none}:${LD_PRELOAD-none}; sleep 2; date +%S";
                status = std::system(command);
              }).join();
              return status == 0 ? 0 : 1;
            }
        """
        program = self.folder / "instrumented-starter"
        subprocess.run(["g++", "-x", "c++", "-", "-fsanitize=thread", "-o", program], input=source, text=True, check=True)
        for command in (program,), (program, program):
            for run in self.assertRepeats(*command):
                self.assertEqual((run.status, run.output), (0, "none:none\n02\n"), run.errors)
        with_path = {**os.environ, "LD_LIBRARY_PATH": "/somewhere"}
        for run in self.assertRepeats("sh", "-c", str(program), env=with_path):
            self.assertEqual((run.status, run.output), (0, "/somewhere:none\n02\n"), run.errors)

    def compile_native(self, name, source):
        """A program that nothing can be preloaded into."""
        program = self.folder / name
        subprocess.run(["gcc", "-static", "-x", "c", "-", "-o", program], input=source, text=True, check=True)
        return program

    def test_native_programs_are_at_the_other_ends_of_pipes(self):
        static = self.compile_native("said", '#include <stdio.h>\nint main(void) { return puts("said by it") < 0; }\n')
        for words in ("bash", "-c", "echo $($0); echo after"), ("dash", "-c", "$0 | cat; echo after"), \
                     (PYTHON, "-c", "import subprocess, sys; print(subprocess.run(sys.argv[1], capture_output=True).stdout)"):
            native = subprocess.run([*words, static], capture_output=True, text=True)
            run = Run(1, *words, static)  # which does not repeat, as such a program does not
            self.assertEqual((run.status, run.output), (native.returncode, native.stdout), run.errors)

    def test_native_programs_get_pipes_by_actions_of_posix_spawn(self):
        static = self.compile_native("heard", "#include <unistd.h>\nint main(void) { char c; while (read(0, &c, 1) == 1) write(1, &c, 1); return 7; }\n")
        code = ("import os, sys; (r, to), (fro, w) = os.pipe(), os.pipe(); dup = os.POSIX_SPAWN_DUP2\n"
                "p = os.posix_spawn(sys.argv[1], sys.argv[1:], {}, file_actions=[(dup, r, 0), (dup, w, 1)])\n"
                "os.close(r); os.close(w); os.write(to, b'twice'); print(os.read(fro, 1)); os.close(to)\n"
                "print(b''.join(iter(lambda: os.read(fro, 9), b'')), os.waitstatus_to_exitcode(os.waitpid(p, 0)[1]))")
        run = Run(1, PYTHON, "-c", code, static)  # which does not repeat, as such a program does not
        self.assertEqual((run.status, run.output), (0, "b't'\nb'wice' 7\n"), run.errors)

    def test_a_native_program_ends_while_another_waits_at_its_pipe(self):
        static = self.compile_native("slow", '#include <unistd.h>\nint main(void) { write(1, "a", 1); return usleep(10000); }\n')
        for _ in range(20):  # its parent or its reader may be the first to find its end
            run = Run(1, "dash", "-c", "$0 | cat; echo after", static)
            self.assertEqual((run.status, run.output), (0, "aafter\n"), run.errors)

    def test_a_killed_process_blocks_no_other(self):
        run = Run(1, "sh", "-c", "sh -c 'kill -KILL $$'; echo $?; sleep 1; date +%S")
        self.assertEqual(run.output, "137\n01\n", run.errors)

    def test_the_death_of_a_writer_is_found_by_its_parent_or_by_another_process(self):
        runs = [Run(1, "bash", "-c", "(yes; echo $? >&2) | head -n 1") for _ in range(10)]
        for run in runs:
            self.assertEqual((run.status, run.output, "141\n" in run.errors), (0, "y\n", True), run.errors)
        self.assertEqual(len({run.digest for run in runs}), 1)

    def test_a_killed_child_is_waited_for_by_a_thread(self):
        for run in self.assertRepeats("python3", "-c", KILLED_CHILD):
            self.assertEqual((run.status, run.output), (0, "timeout -9\n"), run.errors)
            self.assertRegex(run.errors, r" 1\.0\d+ s of virtual time")

    def test_streams_between_processes_that_wait_for_several(self):
        for run in self.assertRepeats("python3", "-c", RELAY, seeds=range(1, 6)):
            self.assertEqual((run.status, run.output), (0, "received 1024003\nrelayed\n"), run.errors)

    def test_a_stream_that_is_watched_while_a_thread_waits(self):
        for run in self.assertRepeats("python3", "-c", WATCHED_LATER):
            self.assertEqual((run.status, run.output), (0, "True 2.0\n"), run.errors)

    def test_a_passed_pipe_is_the_receivers_too(self):
        for run in self.assertRepeats("python3", "-c", PASSED_PIPE):
            self.assertEqual((run.status, run.output), (0, "b'sent'\n"), run.errors)

    def test_a_session_of_init_server_and_clients(self):
        session = self.compile("session.c")
        script = f"{session} init && ({session} serve & {session} ask 3 & {session} ask 2; wait %2 2> /dev/null; sleep 0.2; {session} end; wait); echo $?"
        outputs = set()
        for run in self.assertRepeats("sh", "-c", script, seeds=range(1, 21)):
            self.assertEqual(run.status, 0, run.errors)
            self.assertEqual(run.output.count(" ticks at "), 5, run.output + run.errors)
            self.assertNotIn("TORN", run.output)
            self.assertEqual(run.output.splitlines()[-1], "0")
            outputs.add(run.digest)
        self.assertGreater(len(outputs), 10)

    def test_a_client_before_init_finds_no_devices(self):
        session = self.compile("session.c")
        run = Run(1, "sh", "-c", f"{session} ask 1; echo $?")
        self.assertEqual(run.output, "3\n")


if __name__ == "__main__":
    unittest.main()
