# SPDX-License-Identifier: BSD-3-Clause
"""Accesses to memory in libraries and in generated code: library_accesses_test.py BUILD."""

import re
import subprocess
import unittest

from exec_case import BUILD, ExecCase, explore, replay_words

# An unlocked update in each of two libraries.
COUNTED = """
static int counted;
int NAME(void) { return ++counted; }
"""

PROGRAM = """
#include <dlfcn.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>

int first(void);
int second(void);
static int (*count)(void) = first;

static void* count_once(void* none) { count(); return none; }

int main(int number, char** words) {
  pthread_t threads[2];
  if (number > 1 && strcmp(words[1], "second") == 0) count = second;
  if (number > 2) count = (int (*)(void))dlsym(dlopen(words[2], RTLD_NOW), "third");
  for (int i = 0; i < 2; ++i) pthread_create(&threads[i], NULL, count_once, NULL);
  for (int i = 0; i < 2; ++i) pthread_join(threads[i], NULL);
  return count() == 3 ? 0 : 1;
}
"""


class Libraries(ExecCase):
    def setUp(self):
        if not (BUILD / "libwaitpoint-exec-races.so").exists():
            self.skipTest("this build has no library for accesses")
        self.libraries = self.folder / "libraries"
        self.program = self.libraries / "counting"
        self.third = self.libraries / "libthird.so"
        if self.program.exists():
            return
        self.libraries.mkdir()
        for name in ("first", "second", "third"):
            subprocess.run(["gcc", "-O1", "-shared", "-fPIC", f"-DNAME={name}", "-x", "c", "-", f"-Wl,-soname,lib{name}.so.2",
                            "-o", self.libraries / f"lib{name}.so"], input=COUNTED, text=True, check=True)
        for name in ("first", "second"):
            (self.libraries / f"lib{name}.so.2").symlink_to(f"lib{name}.so")
        subprocess.run(["gcc", "-O1", "-x", "c", "-", "-o", self.program, f"-L{self.libraries}", "-lfirst", "-lsecond",
                        f"-Wl,-rpath,{self.libraries}"], input=PROGRAM, text=True, check=True)

    def explored(self, libraries, *words, schedules="200"):
        at = "accesses" + (f":{libraries}" if libraries else "")
        return explore("--switch-at", at, "--iterations", schedules, "--", self.program, *words)

    def test_are_switch_points_where_the_library_is_named(self):
        self.assertEqual(self.explored("").returncode, 0)
        for name in ("libfirst.so.2", "libfirst.so", "libfirst", self.libraries / "libfirst.so", "libsecond.so,libfirst.so"):
            done = self.explored(name)
            self.assertEqual(done.returncode, 1, f"{name}: {done.stdout}{done.stderr}")
            words = replay_words(done.stdout)
            self.assertIn(f"accesses:{name}", words)
            self.assertIn("the same run as in the record", explore(*words).stderr, name)

    def test_are_those_of_the_named_libraries_only(self):
        self.assertEqual(self.explored("libfirst.so", "second").returncode, 0)
        self.assertEqual(self.explored("libsecond.so", "second").returncode, 1)
        self.assertEqual(self.explored("libfirst.so,libsecond.so", "second").returncode, 1)

    def test_are_found_in_a_library_that_is_loaded_before_a_thread_is_made(self):
        self.assertEqual(self.explored(self.third, "third", self.third).returncode, 1)

    def test_are_reported_as_unexplored_in_a_library_without_a_load(self):
        done = self.explored(self.third, schedules="20")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn(f"; not explored: {self.third}, which the program has not loaded", done.stdout)
        self.assertNotIn("not explored", self.explored("libfirst.so", "second", schedules="20").stdout)

    def test_are_refused_in_one_line_where_the_name_is_wrong(self):
        for name, expected in (("libabsent.so", r"expected a library of counting \(libfirst\.so\.2, libsecond\.so\.2, .*\), or the path "
                                                r"of one that it loads later, found 'libabsent\.so'"),
                               ("/absent/libfirst.so", "expected a shared object for x86-64, found '/absent/libfirst.so'"),
                               (self.program, "expected a shared object for x86-64, found '.*/counting'"),
                               ("libc.so.6", r"expected a library whose calls are not simulated, .*, found 'libc\.so\.6'"),
                               ("libfirst.so,libfirst.so.2", r"expected each library once, found 'libfirst\.so\.2'"),
                               ("libfirst.so,", "expected names of libraries, separated by commas, found 'accesses:libfirst.so,'")):
            done = self.explored(name)
            self.assertEqual(done.returncode, 2, f"{name}: {done.stdout}{done.stderr}")
            self.assertRegex(done.stderr, rf"\A\S*: --switch-at: {expected}\n\Z")


class GeneratedCode(ExecCase):
    PROGRAM = """
#define _GNU_SOURCE
#include <pthread.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

enum { size = 3 * 4096 };
static const unsigned char code[] = {0xb8, 7, 0, 0, 0, 0xc3};  /* mov $7, %eax; ret */
static int (*made)(void);
static int seen;

static int (*generated(const char* how))(void) {
  if (strcmp(how, "none") == 0) return NULL;
  const int is_file = strcmp(how, "memory file") == 0, is_protected = strcmp(how, "protected") == 0;
  const int file = is_file ? memfd_create("code", 0) : -1;
  if (is_file && ftruncate(file, size) != 0) return NULL;
  const int access = PROT_READ | PROT_WRITE | (is_protected ? 0 : PROT_EXEC), flags = is_file ? MAP_SHARED : MAP_PRIVATE | MAP_ANONYMOUS;
  char* const memory = strcmp(how, "by number") == 0 ? (char*)syscall(SYS_mmap, NULL, size, access, flags, file, 0)
                                                     : mmap(NULL, size, access, flags, file, 0);
  memcpy(memory, code, sizeof code);
  if (is_protected) mprotect(memory, size, PROT_READ | PROT_EXEC);
  mprotect(memory, 1, PROT_READ | PROT_EXEC);
  return (int (*)(void))memory;
}

static void* call(void* none) {
  seen = made != NULL ? made() : 7;
  return none;
}

int main(int number, char** words) {
  pthread_t thread;
  made = generated(words[number - 1]);
  pthread_create(&thread, NULL, call, NULL);
  pthread_join(thread, NULL);
  return seen == 7 ? 0 : 1;
}
"""

    def setUp(self):
        self.program = self.folder / "generating"
        if not self.program.exists():
            subprocess.run(["gcc", "-O1", "-w", "-x", "c", "-", "-o", self.program], input=self.PROGRAM, text=True, check=True)

    def summary(self, how, *options):
        done = explore("--iterations", "1000", *options, "--", self.program, how)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout.splitlines()[0]

    def test_is_named_with_its_size_and_nothing_is_exhausted(self):
        for how in ("mapped", "protected", "memory file", "by number"):
            for options in ((), ("--strategy", "dfs"), ("--switch-at", "calls")):
                summary = self.summary(how, *options)
                self.assertTrue(summary.endswith("; not explored: 12288 bytes of code generated at run time"), summary)
                self.assertNotRegex(summary, "exhaust", (how, options))
        self.assertIn("the program generates code", self.summary("mapped", "--strategy", "dfs"))

    def test_is_named_in_a_child_process(self):
        done = explore("--iterations", "20", "--", "sh", "-c", f"{self.program} mapped; :")
        self.assertRegex(done.stdout, "^sh: .*; not explored: 12288 bytes of code generated at run time\n")

    def test_is_not_what_the_program_was_compiled_to(self):
        summary = self.summary("none")
        self.assertNotIn("generated", summary)
        self.assertRegex(summary, "exhausted, no other ordering exists", summary)


if __name__ == "__main__":
    unittest.main()
