// SPDX-License-Identifier: BSD-3-Clause
// exec, and calls that start programs.
#include "tests/exec/conformance/processes.h"

#include <fcntl.h>
#include <spawn.h>
#include <stdatomic.h>

static pid_t begin_child(void) {
  const pid_t child = fork();
  EXPECT(child >= 0);
  return child;
}

static char* const environment[] = {"PATH=/bin:/usr/bin", "WORD=12", NULL};

CASE(execv_becomes_a_program) {
  const pid_t child = begin_child();
  if (child == 0) execv("/bin/sh", say_11);
  EXPECT_EXIT(child, 11);
}
CASE(execve_gives_an_environment) {
  char* const words[] = {"sh", "-c", "exit $WORD", NULL};
  const pid_t child = begin_child();
  if (child == 0) execve("/bin/sh", words, environment);
  EXPECT_EXIT(child, 12);
}
CASE(execvp_looks_along_the_path) {
  const pid_t child = begin_child();
  if (child == 0) execvp("sh", say_11);
  EXPECT_EXIT(child, 11);
}
CASE(execvpe_looks_and_gives_an_environment) {
  char* const words[] = {"sh", "-c", "exit $WORD", NULL};
  const pid_t child = begin_child();
  if (child == 0) execvpe("sh", words, environment);
  EXPECT_EXIT(child, 12);
}
CASE(execl_and_its_kin_take_words) {
  pid_t child = begin_child();
  if (child == 0) execl("/bin/sh", "sh", "-c", "exit $#", "zero", "one", "two", (char*)NULL);
  EXPECT_EXIT(child, 2);
  child = begin_child();
  if (child == 0) execlp("sh", "sh", "-c", "exit 13", (char*)NULL);
  EXPECT_EXIT(child, 13);
  child = begin_child();
  if (child == 0) execle("/bin/sh", "sh", "-c", "exit $WORD", (char*)NULL, environment);
  EXPECT_EXIT(child, 12);
}
CASE(fexecve_becomes_what_is_open) {
  const int descriptor = open("/bin/sh", O_RDONLY);
  const pid_t child = begin_child();
  if (child == 0) fexecve(descriptor, say_11, environment);
  EXPECT_EXIT(child, 11);
}
CASE(what_is_not_there_cannot_be_executed) {
  EXPECT_FAILS(execv("/nonexistent/program", say_11), ENOENT);
  EXPECT_FAILS(execvp("no-such-program-anywhere", say_11), ENOENT);
  EXPECT_FAILS(execve("/etc/passwd", say_11, environment), EACCES);
  sleep_ms(1);  // threads continue
}
CASE(a_program_inherits_what_is_blocked_and_ignored) {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGUSR1);
  sigprocmask(SIG_BLOCK, &set, NULL);
  signal(SIGUSR2, SIG_IGN);
  const pid_t child = begin_child();
  if (child == 0)
    execl("/bin/grep", "grep", "-c", "-E", "SigBlk:.*200$|SigIgn:.*8..$", "/proc/self/status", (char*)NULL);
  EXPECT_EXIT(child, 0);
}

/// This program with these words ends with 0 if SIGUSR1 is blocked and SIGUSR2 is not.
static char* const tell_blocked[] = {"self", "--is-blocked", NULL};
__attribute__((constructor)) static void end_if_asked(int argc, char** argv) {
  if (argc != 2 || strcmp(argv[1], tell_blocked[1]) != 0) return;
  sigset_t set;
  sigprocmask(SIG_BLOCK, NULL, &set);
  _exit(sigismember(&set, SIGUSR1) == 1 && sigismember(&set, SIGUSR2) == 0 ? 0 : 1);
}
static const char* own_file(void) {
  static char path[4096];
  EXPECT(readlink("/proc/self/exe", path, sizeof path - 1) > 0);
  return path;
}
/// Makes this program one that is found along the path.
static const char* own_name(void) {
  static char path[4096];
  strcpy(path, own_file());
  char* const name = strrchr(path, '/');
  *name = '\0';
  setenv("PATH", path, 1);
  return name + 1;
}

static void become(int way) {
  const char *const file = own_file(), *const name = own_name();
  char* const* const words = tell_blocked;
  switch (way) {
    case 0: execv(file, words); break;
    case 1: execve(file, words, environment); break;
    case 2: execvp(name, words); break;
    case 3: execvpe(name, words, environment); break;
    case 4: fexecve(open(file, O_RDONLY), words, environment); break;
    case 5: execl(file, words[0], words[1], (char*)NULL); break;
    case 6: execlp(name, words[0], words[1], (char*)NULL); break;
    default: execle(file, words[0], words[1], (char*)NULL, environment); break;
  }
}
CASE(whatever_becomes_a_program_hands_on_what_is_blocked) {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGUSR1);
  sigprocmask(SIG_BLOCK, &set, NULL);
  for (int way = 0; way < 8; ++way) {
    const pid_t child = begin_child();
    if (child == 0) become(way);
    EXPECT_EXIT(child, 0);
  }
}
CASE_ENDING_WITH(14, a_process_of_threads_becomes_one_without) {
  start(run_on, NULL);
  sleep_ms(2);
  execl("/bin/sh", "sh", "-c", "exit 14", (char*)NULL);
}
CASE(system_gives_the_status_of_the_shell) {
  EXPECT(system(NULL) != 0);
  const int status = system("exit 15");
  EXPECT(WIFEXITED(status) && WEXITSTATUS(status) == 15);
  EXPECT_IS(WEXITSTATUS(system("no-such-program-anywhere 2> /dev/null")), 127);
  const int signalled = system("kill -TERM $$");
  EXPECT(WIFSIGNALED(signalled) && WTERMSIG(signalled) == SIGTERM);
}
CASE(system_leaves_signals_as_they_were) {
  signal(SIGINT, nothing);
  EXPECT_IS(system("kill -INT $PPID; exit 3"), 3 << 8);
  EXPECT(signal(SIGINT, SIG_DFL) == nothing);
  sigset_t now;
  sigprocmask(SIG_BLOCK, NULL, &now);
  EXPECT_IS(sigismember(&now, SIGCHLD), 0);
}

static void* count_on(void* word) {
  for (int i = 0; i < 20; ++i) {
    sleep_ms(1);
    atomic_fetch_add((atomic_int*)word, 1);
  }
  return NULL;
}
CASE(others_go_on_while_system_waits) {
  static atomic_int count;
  const pthread_t id = start(count_on, &count);
  EXPECT_IS(system("sleep 0.3"), 0);
  EXPECT_IS(count, 20);
  join(id);
}
CASE(popen_reads_and_writes) {
  char line[32] = "";
  FILE* file = popen("echo from a shell", "r");
  EXPECT(file != NULL);
  EXPECT(fgets(line, sizeof line, file) != NULL);
  EXPECT_IS(strcmp(line, "from a shell\n"), 0);
  EXPECT_IS(pclose(file), 0);
  file = popen("read x; exit $x", "w");
  fprintf(file, "16\n");
  EXPECT_IS(WEXITSTATUS(pclose(file)), 16);
}
CASE(posix_spawn_starts_a_program) {
  pid_t child = 0;
  EXPECT_IS(posix_spawn(&child, "/bin/sh", NULL, NULL, say_11, environment), 0);
  EXPECT_EXIT(child, 11);
  EXPECT_IS(posix_spawnp(&child, "sh", NULL, NULL, say_11, environment), 0);
  EXPECT_EXIT(child, 11);
  EXPECT_IS(posix_spawn(&child, "/nonexistent/program", NULL, NULL, say_11, environment), ENOENT);
  EXPECT_IS(posix_spawnp(&child, "no-such-program-anywhere", NULL, NULL, say_11, environment), ENOENT);
}
CASE(posix_spawn_inherits_what_is_blocked) {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGUSR1);
  sigprocmask(SIG_BLOCK, &set, NULL);
  pid_t child = 0;
  EXPECT_IS(posix_spawn(&child, own_file(), NULL, NULL, tell_blocked, environment), 0);
  EXPECT_EXIT(child, 0);
  EXPECT_IS(posix_spawnp(&child, own_name(), NULL, NULL, tell_blocked, environment), 0);
  EXPECT_EXIT(child, 0);
}
CASE(posix_spawn_acts_on_descriptors) {
  int ends[2];
  EXPECT_IS(pipe(ends), 0);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], 1);
  char* const words[] = {"sh", "-c", "echo said", NULL};
  pid_t child = 0;
  EXPECT_IS(posix_spawn(&child, "/bin/sh", &actions, NULL, words, environment), 0);
  char text[8] = "";
  EXPECT_IS(read(ends[0], text, 5), 5);
  EXPECT_IS(strcmp(text, "said\n"), 0);
  EXPECT_EXIT(child, 0);
}
