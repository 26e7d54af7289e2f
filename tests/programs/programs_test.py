# SPDX-License-Identifier: BSD-3-Clause
"""Programs that users build outside the tree work with the installed library: programs_test.py BUILD."""

import re
import subprocess

from installed import BUILD, HERE, Installed, flags, main, run


class Headers(Installed):
    def test_they_need_neither_the_tree_nor_other_libraries(self):
        # The headers of real threads replace those of simulated ones; both together cannot be included.
        headers = sorted(path.relative_to(self.prefix / "include") for path in (self.prefix / "include").rglob("*.hpp")
                         if not path.name.startswith("real_"))
        self.assertGreater(len(headers), 50)
        text = "".join(f"#include <{header}>\n" for header in headers)
        source = self.folder / "all.cpp"
        source.write_text(text)
        run("g++", "-std=c++20", "-fsyntax-only", *flags(self.prefix, "--cflags", "waitpoint-robots"), source)
        self.assertFalse(re.search(r"<(Eigen|fcl|yaml-cpp|nlohmann|CLI)/", "".join(path.read_text() for path in
                                   self.prefix.rglob("*.hpp"))), "a header asks for a library that users need not have")

    def test_a_folder_of_a_users_own_is_not_taken_for_one_of_ours(self):
        (self.folder / "own/core").mkdir(parents=True)
        (self.folder / "own/core/time.hpp").write_text("#error a user's own header\n")
        source = self.folder / "own/main.cpp"
        source.write_text("#include <waitpoint/fibers/explore/explore.hpp>\n#include <waitpoint/modules/genom/module.hpp>\n")
        run("g++", "-std=c++20", "-fsyntax-only", "-I.", *flags(self.prefix, "--cflags", "waitpoint-robots"), source,
            cwd=source.parent)


# The functions of the C library that waitpoint and waitpoint-robots stand before: docs/failures.md names them.
BEFORE_THE_C_LIBRARY = {
    "libwaitpoint": set(
        """pthread_create thrd_create system popen posix_spawn posix_spawnp fork vfork nanosleep clock_nanosleep usleep sleep
        poll ppoll select pselect epoll_wait accept wait waitpid pthread_join pthread_exit pthread_barrier_wait pthread_cond_wait
        pthread_cond_timedwait pthread_cond_clockwait sem_wait sem_timedwait sem_clockwait pthread_mutex_lock
        pthread_mutex_timedlock pthread_mutex_clocklock pthread_rwlock_rdlock pthread_rwlock_wrlock syscall
        pthread_cancel thrd_exit""".split()
    ),
    "libwaitpoint-robots": set(
        """_exit _Exit daemon execl execle execlp execv execve execveat execvp execvpe fexecve
        sigaction signal sigprocmask pthread_sigmask sigaltstack exit raise kill killpg tgkill sigqueue pthread_kill
        pthread_sigqueue""".split()
    ),
}


class Libraries(Installed):
    """The shared libraries, as they are installed."""

    def shared(self):
        return sorted(path for path in self.libraries.glob("libwaitpoint*.so*") if not path.is_symlink())

    def test_export_names_of_waitpoint_alone(self):
        self.assertTrue(self.shared())
        for library in self.shared():
            names = {line.split()[-1] for line in run("nm", "--dynamic", "--defined-only", library).splitlines()}
            self.assertTrue(names)
            ours = ("waitpoint_", "__sanitizer_cov_")
            foreign = [name for name in names if "9waitpoint" not in name and not name.startswith(ours)]
            self.assertEqual(set(foreign), BEFORE_THE_C_LIBRARY.get(library.name.split(".")[0], set()), library.name)

    def test_have_their_debugging_information_in_files_beside_them(self):
        for library in self.shared():
            self.assertNotIn(".debug_line", run("readelf", "--section-headers", "--wide", library))
            beside = library.parent / ".debug" / f"{library.name}.debug"
            self.assertIn(".debug_line", run("readelf", "--section-headers", "--wide", beside))
        sizes = {path: path.stat().st_size for path in self.libraries.rglob("*.debug")}
        run("meson", "install", "-C", BUILD, "--no-rebuild", "--only-changed", "--destdir", self.folder / "root")
        self.assertEqual({path: path.stat().st_size for path in self.libraries.rglob("*.debug")}, sizes, "split twice")
        threads = (self.libraries / "libwaitpoint.so").resolve()
        symbols = run("nm", "--dynamic", "--demangle", threads).splitlines()
        simulate = next(line.split()[0] for line in symbols if " T waitpoint::simulate(" in line)
        self.assertIn("simulation.cpp", run("addr2line", "-e", threads, simulate))

    def test_keep_a_users_program_small(self):
        program = self.compile("blinker", *flags(self.prefix, "--cflags", "--libs", "waitpoint-robots"))
        self.assertLess(program.stat().st_size, 30e6)
        stripped = self.folder / "blinker-stripped"
        run("strip", program, "-o", stripped)
        self.assertLess(stripped.stat().st_size, 5e6)

    def test_no_test_is_installed_with_them(self):
        self.assertEqual([path for path in self.prefix.rglob("test-*")], [])


class Scenarios(Installed):
    """An installed scenario is named without its folder."""

    def waitpoint(self, *words, folder=None):
        done = subprocess.run([self.prefix / "bin/waitpoint", *words], capture_output=True, text=True, timeout=120,
                              cwd=folder or self.folder)
        return done.returncode, done.stdout + done.stderr

    def digest(self, *words, **options):
        status, output = self.waitpoint(*words, **options)
        self.assertIn(status, (0, 1), output)
        return re.search(r"wp1:[0-9a-f]{16}", output)[0]

    def test_is_found_by_every_command(self):
        here = self.prefix / "share/waitpoint/scenarios/office.yaml"
        digest = self.digest("run", here, "--until", "2")
        self.assertEqual(self.digest("run", "office.yaml", "--until", "2"), digest)
        self.assertEqual(self.digest("run", "office.yaml", "--until", "2", "--verify"), digest)
        self.assertEqual(self.waitpoint("check", "office.yaml"), self.waitpoint("check", here))
        status, output = self.waitpoint("explore", "office.yaml", "--until", "1", "--iterations", "2")
        self.assertEqual(status, 0, output)

    def test_is_named_with_its_folder_in_replay_lines(self):
        status, output = self.waitpoint("run", "office.yaml", "--until", "2", "--set", "expect.goals_reached=9")
        found = self.waitpoint("explore", "office.yaml", "--until", "1", "--iterations", "1", "--property", "goals_reached=9")
        self.assertEqual((status, found[0]), (1, 1), output + found[1])
        line = re.search(r"(?m)^replay: (.*)$", found[1])[1]
        self.assertIn(f"{self.prefix}/share/waitpoint/scenarios/office.yaml", line)

    def test_a_file_of_that_name_here_is_preferred(self):
        folder = self.folder / "with office"
        folder.mkdir()
        (folder / "office.yaml").write_text("format: 2\n")
        status, output = self.waitpoint("run", "office.yaml", folder=folder)
        self.assertEqual(status, 2)
        self.assertTrue(output.startswith("waitpoint: office.yaml:1: "), output)

    def test_another_name_is_not_found(self):
        self.assertEqual(self.waitpoint("run", "offices.yaml")[0], 2)
        self.assertEqual(self.waitpoint("run", "scenarios/office.yaml")[0], 2)


class Blinker(Installed):
    """A user's own modules, in a robot without other modules, base and goals."""

    def test_runs_its_scenario_and_repeats(self):
        program = self.compile("blinker", *flags(self.prefix, "--cflags", "--libs", "waitpoint-robots"))
        outputs = [run(program, "run", HERE / "blinker/blinker.yaml", "--events", self.folder / "events") for _ in range(2)]
        lines = outputs[0].splitlines()
        self.assertEqual([line.split(": ")[1] for line in lines if "the lamp is" in line], ["the lamp is on", "the lamp is off"] * 3)
        self.assertIn("final reply: ok", outputs[0])
        self.assertEqual([line for line in lines if re.match("  (goals|distance|collisions|position|odometry)", line)], [])
        digests = [re.findall(r"wp1:[0-9a-f]{16}", output) for output in outputs]
        self.assertTrue(digests[0])
        self.assertEqual(digests[0], digests[1])
        self.assertIn(digests[0][-1], (HERE.parents[1] / "docs/robots.md").read_text(), "docs/robots.md shows another digest")
        self.assertIn("lighthouse", (self.folder / "events").read_text())

        other = run(program, "run", HERE / "blinker/blinker.yaml", "--set", "robots.0.modules.watchman.flashes=1")
        self.assertEqual(other.count("the lamp is on"), 1)
        self.assertNotEqual(re.findall(r"wp1:[0-9a-f]{16}", other), digests[0])

        wrong = subprocess.run([program, "run", HERE / "blinker/blinker.yaml", "--set", "robots.0.modules.watchman.flashs=1"],
                               capture_output=True, text=True)
        self.assertEqual(wrong.returncode, 2)
        self.assertIn("did you mean 'flashes'?", wrong.stderr)

    def test_stands_beside_the_papers_modules(self):
        scenario = self.prefix / "share/waitpoint/scenarios/office.yaml"
        program = self.compile("blinker", *flags(self.prefix, "--cflags", "--libs", "waitpoint-robots"))
        mixed = self.folder / "mixed.yaml"
        mixed.write_text(f"""
format: 1
name: mixed
until_s: 3
world: {{include: {scenario.parent}/office-floor.yaml}}
robot_types: {{include: {scenario.parent}/rackham.yaml}}
robots:
  - {{name: rackham, type: rackham, start: [20, 4, 90], goals: [[22.4, 6.6]], modules: [{{name: blinker}}, {{name: watchman}}]}}
""")
        self.assertEqual(run(program, "run", mixed, "--until", "3").count("the lamp is on"), 3)

    def test_the_same_source_runs_on_the_threads_of_the_system(self):
        needed = flags(self.prefix, "--cflags", "--libs", "waitpoint-robots-native")
        program = self.compile("blinker", *needed, program="blinker_native")
        output = run(program, "run", HERE / "blinker/blinker.yaml", timeout=60)
        seen = [line.split(": ")[1] for line in output.splitlines() if "the lamp is" in line]
        self.assertEqual(seen[:2], ["the lamp is on", "the lamp is off"])
        self.assertIn("on real threads", output)

    def test_code_for_one_kind_of_threads_is_not_linked_with_the_other(self):
        mixed = [flag for flag in flags(self.prefix, "--cflags", "--libs", "waitpoint-robots-native")
                 if flag != "-DWAITPOINT_REAL_THREADS"]
        with self.assertRaisesRegex(AssertionError, "threads::simulated"):
            self.compile("blinker", *mixed, program="blinker_mixed")


class TwoRobots(Installed):
    """Robots that communicate over the medium of their scenario."""

    def outcome(self, *options):
        program = self.compile("two_robots", *flags(self.prefix, "--cflags", "--libs", "waitpoint-robots"))
        output = run(program, "run", HERE / "two_robots/two_robots.yaml", *options)
        # (time, robot, event, positions, log entries), and the digest of the run
        told = re.findall(r"^ *([\d.]+) s  (\w+) (.*) \((\d+) positions, (\d+) log entries\)$", output, re.MULTILINE)
        return told, re.findall(r"wp1:[0-9a-f]{16}", output)[-1]

    def test_lose_sight_of_each_other_and_no_letter(self):
        told, digest = self.outcome()
        self.assertEqual([(who, what) for _, who, what, _, _ in told],
                         [("ada", "hears bea"), ("bea", "hears ada"), ("ada", "has lost bea"), ("bea", "has lost ada"),
                          ("ada", "hears bea"), ("bea", "hears ada")])
        for _, _, what, positions, entries in told[2:]:
            # At 5 positions a second for 20 s some are lost; the log waits while out of range, and arrives completely.
            self.assertLess(int(positions), 90)
            self.assertEqual(int(entries), 34 if what.startswith("hears") else 18)
        self.assertEqual(self.outcome()[1], digest)
        document = (HERE.parents[1] / "docs/communication.md").read_text()
        self.assertIn(digest, document, "docs/communication.md shows another digest")

    def test_the_medium_is_the_scenarios_to_say(self):
        told, digest = self.outcome("--set", "medium.loss=0")
        self.assertEqual([positions for _, _, what, positions, _ in told if "lost" in what], ["91", "91"])
        self.assertNotEqual(digest, self.outcome()[1])
        self.assertEqual(self.outcome("--set", "medium.loss=1")[0], [])
        self.assertEqual([what for _, _, what, _, _ in self.outcome("--set", "medium=")[0]], ["cannot send: no route"] * 2)


LARGE_FRAME = """
#include <waitpoint/fibers/sync/simulation.hpp>
#include <waitpoint/fibers/sync/threads.hpp>
int main() {
  waitpoint::simulate([] {
    waitpoint::thread glutton({.name = "glutton"}, [] {
      volatile char frame[1000000];
      frame[0] = 1;
    });
    glutton.join();
  });
}
"""


class LargeFrame(Installed):
    def test_does_not_step_over_the_guard_page(self):
        source = self.folder / "large_frame.cpp"
        source.write_text(LARGE_FRAME)
        program = self.folder / "large_frame"
        needed = flags(self.prefix, "--cflags", "--libs", "waitpoint")
        run("g++", "-std=c++20", "-O2", source, "-o", program, *needed, cwd=self.folder)
        done = subprocess.run([program], capture_output=True, text=True)
        self.assertNotEqual(done.returncode, 0)
        self.assertRegex(done.stderr, r"ran over the end of its stack\n.*in task glutton")


# The primitives of threads.hpp, on the standard library's threads.
REAL_THREADS = """
#include <waitpoint/fibers/sync/threads.hpp>
#include <waitpoint/modules/genom/client.hpp>
namespace threads = waitpoint::threads;
int main() {
  using namespace std::chrono_literals;
  threads::mutex door("door");
  threads::condition_variable bell("bell");
  threads::counting_semaphore<> read(0);
  bool delivered = false;
  threads::thread reader({.name = "reader"}, [&] {
    std::unique_lock lock(door);
    bell.wait(lock, [&] { return delivered; });
    read.release();
  });
  threads::periodic_timer(waitpoint::Period::every(1ms)).wait();
  {
    const std::lock_guard lock(door);
    delivered = true;
  }
  bell.notify_one();
  read.acquire();
  reader.join();
}
"""


class RealThreads(Installed):
    def test_the_same_source_runs_on_them(self):
        source = self.folder / "real.cpp"
        source.write_text(REAL_THREADS)
        needed = flags(self.prefix, "--cflags", "--libs", "waitpoint")
        run("g++", "-std=c++20", "-DWAITPOINT_REAL_THREADS", source, "-o", self.folder / "real", *needed, "-pthread")
        run(self.folder / "real", timeout=20)


class Moved(Installed):
    """A tree that is not where it was to be installed; here by --destdir."""

    def test_finds_its_libraries_and_scenarios(self):
        if not list(self.prefix.rglob("libwaitpoint-exec.so")):
            self.skipTest("this build has no library for programs")
        self.assertEqual(run(self.prefix / "bin/waitpoint", "exec", "--", "echo", "heard"), "heard\n")
        run(self.prefix / "bin/waitpoint", "check", "office.yaml", cwd=self.folder)


if __name__ == "__main__":
    main()
