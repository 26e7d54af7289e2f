// SPDX-License-Identifier: BSD-3-Clause
// Children, the programs that they become, and how processes end.
#include "tests/exec/conformance/harness.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdatomic.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>

static int status_of(pid_t child) {
  int status = -1;
  EXPECT_IS(waitpid(child, &status, 0), child);
  return status;
}
static void expect_exit(const char* file, int line, pid_t child, int expected) {
  const int status = status_of(child);
  expect_equal(file, line, "it exited", WIFEXITED(status), 1);
  expect_equal(file, line, "its status", WEXITSTATUS(status), expected);
}
#define EXPECT_EXIT(child, expected) expect_exit(__FILE__, __LINE__, child, expected)
/// Memory that a child shares.
static volatile int* shared(void) {
  volatile int* const word = mmap(NULL, 4096, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  EXPECT(word != MAP_FAILED);
  return word;
}

CASE(a_child_has_another_number_and_knows_its_parent) {
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child == 0) _exit(getppid() == parent && getpid() != parent && gettid() == getpid() ? 5 : 6);
  EXPECT(child > 0);
  EXPECT_EXIT(child, 5);
}
CASE(a_child_has_its_own_memory) {
  static int word = 1;
  const pid_t child = fork();
  if (child == 0) {
    word = 2;
    _exit(word);
  }
  EXPECT_EXIT(child, 2);
  EXPECT_IS(word, 1);
}
CASE(a_child_shares_descriptors) {
  int ends[2];
  EXPECT_IS(pipe(ends), 0);
  const pid_t child = fork();
  if (child == 0) _exit(write(ends[1], "hello", 5) == 5 ? 0 : 1);
  char text[8] = "";
  EXPECT_IS(read(ends[0], text, 5), 5);
  EXPECT_IS(strcmp(text, "hello"), 0);
  EXPECT_EXIT(child, 0);
}
CASE(a_child_can_be_spoken_with) {
  int there[2], back[2];
  char byte = 0;
  EXPECT_IS(pipe(there), 0);
  EXPECT_IS(pipe(back), 0);
  const pid_t child = fork();
  if (child == 0) {
    for (int i = 0; i < 10; ++i) {
      if (read(there[0], &byte, 1) != 1) _exit(1);
      ++byte;
      if (write(back[1], &byte, 1) != 1) _exit(1);
    }
    _exit(0);
  }
  for (char i = 0; i < 20; i += 2) {
    EXPECT_IS(write(there[1], &i, 1), 1);
    EXPECT_IS(read(back[0], &byte, 1), 1);
    EXPECT_IS(byte, i + 1);
  }
  EXPECT_EXIT(child, 0);
}
static void* run_on(void* unused) {
  for (;;) sleep_ms(1);
  return unused;
}
CASE(a_child_has_only_the_thread_that_made_it) {
  start(run_on, NULL);
  const pid_t child = fork();
  if (child == 0) {
    sleep_ms(5);
    _exit(3);
  }
  EXPECT_EXIT(child, 3);
}
static void* give_7(void* unused) {
  (void)unused;
  sleep_ms(1);
  return (void*)7;
}
CASE(a_child_can_have_threads) {
  const pid_t child = fork();
  if (child == 0) _exit((int)(long)join(start(give_7, NULL)));
  EXPECT_EXIT(child, 7);
}
static void* fork_in_thread(void* unused) {
  const pid_t child = fork();
  if (child == 0) exit((int)(long)join(start(give_7, NULL)));
  EXPECT_EXIT(child, 7);
  return unused;
}
CASE(a_thread_can_have_children) { join(start(fork_in_thread, NULL)); }
CASE(a_child_of_a_child_is_waited_for_by_it) {
  const pid_t child = fork();
  if (child == 0) {
    const pid_t grandchild = fork();
    if (grandchild == 0) _exit(4);
    EXPECT_EXIT(grandchild, 4);
    _exit(5);
  }
  EXPECT_EXIT(child, 5);
}
static void nothing(int signal) { (void)signal; }
CASE(a_child_inherits_masks_and_handlers_but_nothing_pends) {
  sigset_t set, now;
  sigemptyset(&set);
  sigaddset(&set, SIGUSR1);
  sigprocmask(SIG_BLOCK, &set, NULL);
  signal(SIGUSR2, nothing);
  raise(SIGUSR1);
  const pid_t child = fork();
  if (child == 0) {
    sigprocmask(SIG_BLOCK, NULL, &now);
    EXPECT_IS(sigismember(&now, SIGUSR1), 1);
    sigpending(&now);
    EXPECT_IS(sigismember(&now, SIGUSR1), 0);
    EXPECT(signal(SIGUSR2, SIG_DFL) == nothing);
    _exit(0);
  }
  EXPECT_EXIT(child, 0);
  sigpending(&now);
  EXPECT_IS(sigismember(&now, SIGUSR1), 1);
}
CASE(a_child_has_no_alarm) {
  alarm(100);
  const pid_t child = fork();
  if (child == 0) _exit((int)alarm(0));
  EXPECT_EXIT(child, 0);
  EXPECT(alarm(0) > 90);
}

// Waiting.

CASE(wait_takes_any_child) {
  const pid_t child = fork();
  if (child == 0) _exit(9);
  int status = 0;
  EXPECT_IS(wait(&status), child);
  EXPECT_IS(WEXITSTATUS(status), 9);
  EXPECT_FAILS(wait(&status), ECHILD);
}
CASE(wait3_and_wait4_tell_what_was_used) {
  struct rusage usage;
  int status = 0;
  pid_t child = fork();
  if (child == 0) _exit(1);
  memset(&usage, 0x55, sizeof usage);
  EXPECT_IS(wait3(&status, 0, &usage), child);
  EXPECT(usage.ru_maxrss != 0x5555555555555555);
  child = fork();
  if (child == 0) _exit(2);
  EXPECT_IS(wait4(child, &status, 0, &usage), child);
  EXPECT_IS(WEXITSTATUS(status), 2);
}
CASE(each_child_is_waited_for_once) {
  pid_t children[4];
  for (int i = 0; i < 4; ++i) {
    children[i] = fork();
    if (children[i] == 0) _exit(10 + i);
  }
  for (int i = 3; i >= 0; --i) EXPECT_EXIT(children[i], 10 + i);
  EXPECT_FAILS(waitpid(children[0], NULL, 0), ECHILD);
  EXPECT_FAILS(waitpid(-1, NULL, WNOHANG), ECHILD);
}
CASE(WNOHANG_does_not_wait) {
  int ends[2];
  EXPECT_IS(pipe(ends), 0);
  const pid_t child = fork();
  char byte;
  if (child == 0) _exit(read(ends[0], &byte, 1) == 1 ? 0 : 1);
  EXPECT_IS(waitpid(child, NULL, WNOHANG), 0);
  EXPECT_IS(write(ends[1], "x", 1), 1);
  int status = -1;
  while (waitpid(child, &status, WNOHANG) == 0) sleep_ms(1);
  EXPECT_IS(status, 0);
}
CASE(who_is_ended_by_a_signal_says_so) {
  pid_t child = fork();
  if (child == 0) {
    raise(SIGTERM);
    _exit(1);
  }
  int status = status_of(child);
  EXPECT(WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM);
  child = fork();
  if (child == 0) abort();
  status = status_of(child);
  EXPECT(WIFSIGNALED(status) && WTERMSIG(status) == SIGABRT);
}
CASE(a_parent_can_end_its_child) {
  const pid_t child = fork();
  if (child == 0)
    for (;;) pause();
  EXPECT_IS(kill(child, SIGKILL), 0);
  const int status = status_of(child);
  EXPECT(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
}
CASE(a_stopped_child_is_told_of) {
  const pid_t child = fork();
  if (child == 0) {
    raise(SIGSTOP);
    usleep(100000);
    _exit(8);
  }
  int status = 0;
  EXPECT_IS(waitpid(child, &status, WUNTRACED), child);
  EXPECT(WIFSTOPPED(status) && WSTOPSIG(status) == SIGSTOP);
  EXPECT_IS(kill(child, SIGCONT), 0);
  EXPECT_IS(waitpid(child, &status, WCONTINUED), child);
  EXPECT(WIFCONTINUED(status));
  EXPECT_EXIT(child, 8);
}
CASE(waitid_tells_in_a_record) {
  const pid_t child = fork();
  if (child == 0) _exit(21);
  siginfo_t information;
  memset(&information, 0, sizeof information);
  EXPECT_IS(waitid(P_PID, (id_t)child, &information, WEXITED | WNOWAIT), 0);
  EXPECT_IS(information.si_signo, SIGCHLD);
  EXPECT_IS(information.si_code, CLD_EXITED);
  EXPECT_IS(information.si_status, 21);
  EXPECT_IS(information.si_pid, child);
  EXPECT_IS(waitid(P_ALL, 0, &information, WEXITED), 0);
  EXPECT_IS(information.si_pid, child);
  EXPECT_FAILS(waitid(P_ALL, 0, &information, WEXITED), ECHILD);
  EXPECT_FAILS(waitid(P_ALL, 0, &information, 0), EINVAL);
}
static atomic_int children_ended;
static void count_child(int signal) {
  (void)signal;
  atomic_fetch_add(&children_ended, 1);
}
CASE(the_end_of_a_child_is_a_signal) {
  signal(SIGCHLD, count_child);
  const pid_t child = fork();
  if (child == 0) _exit(0);
  while (children_ended == 0) sleep_ms(1);
  EXPECT_EXIT(child, 0);
}
CASE(pause_ends_with_a_child) {
  sigset_t set, before;
  sigemptyset(&set);
  sigaddset(&set, SIGCHLD);
  signal(SIGCHLD, count_child);
  sigprocmask(SIG_BLOCK, &set, &before);
  const pid_t child = fork();
  if (child == 0) _exit(0);
  while (children_ended == 0) sigsuspend(&before);
  EXPECT_EXIT(child, 0);
}
CASE(children_that_nobody_asks_for_leave_nothing) {
  signal(SIGCHLD, SIG_IGN);
  const pid_t child = fork();
  if (child == 0) _exit(0);
  EXPECT_FAILS(waitpid(child, NULL, 0), ECHILD);
}
CASE(processes_wait_for_each_other_by_sleeping) {
  volatile int* const word = shared();
  const pid_t child = fork();
  if (child == 0) {
    usleep(20000);
    *word = 1;
    _exit(0);
  }
  usleep(400000);
  EXPECT_IS(*word, 1);
  EXPECT_EXIT(child, 0);
}
CASE(a_child_is_sent_a_signal_that_it_handles) {
  const pid_t child = fork();
  if (child == 0) {
    signal(SIGUSR1, count_child);
    const unsigned left = sleep(10);
    _exit(children_ended == 1 && left >= 8 ? 0 : 1);
  }
  usleep(200000);
  EXPECT_IS(kill(child, SIGUSR1), 0);
  EXPECT_EXIT(child, 0);
}
CASE(a_parent_is_sent_a_signal_that_it_handles) {
  signal(SIGUSR1, count_child);
  const pid_t child = fork();
  if (child == 0) {
    usleep(50000);
    _exit(kill(getppid(), SIGUSR1));
  }
  while (children_ended == 0) pause();
  EXPECT_EXIT(child, 0);
}
CASE(a_thread_waits_for_a_child_while_others_go_on) {
  int ends[2];
  EXPECT_IS(pipe(ends), 0);
  const pid_t child = fork();
  char byte;
  if (child == 0) _exit(read(ends[0], &byte, 1) == 1 ? 0 : 1);
  int* const end = &ends[1];
  pthread_t id;
  extern void* write_later(void*);
  EXPECT_IS(pthread_create(&id, NULL, write_later, end), 0);
  EXPECT_EXIT(child, 0);
  join(id);
}
static pid_t wait_so(int way, pid_t child) {
  siginfo_t information;
  switch (way) {
    case 0: return wait(NULL);
    case 1: return wait3(NULL, 0, NULL);
    case 2: return wait4(child, NULL, 0, NULL);
    case 3: return waitpid(-1, NULL, 0);
    default: return waitid(P_PID, (id_t)child, &information, WEXITED) == 0 ? information.si_pid : -1;
  }
}
CASE(every_way_to_wait_lets_others_go_on) {
  extern void* write_later(void*);
  for (int way = 0; way < 5; ++way) {
    int ends[2];
    EXPECT_IS(pipe(ends), 0);
    const pid_t child = fork();
    char byte;
    if (child == 0) _exit(read(ends[0], &byte, 1) == 1 ? 0 : 1);
    const pthread_t id = start(write_later, &ends[1]);
    EXPECT_IS(wait_so(way, child), child);
    join(id);
  }
}
void* write_later(void* end);
void* write_later(void* end) {
  sleep_ms(5);
  EXPECT_IS(write(*(int*)end, "x", 1), 1);
  return NULL;
}

// Becoming another program.

static pid_t begin_child(void) {
  const pid_t child = fork();
  EXPECT(child >= 0);
  return child;
}
static char* const say_11[] = {"sh", "-c", "exit 11", NULL};
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
  sleep_ms(1);  // threads go on
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
static void become(int way) {
  static char* const words[] = {"grep", "-q", "SigBlk:.*200$", "/proc/self/status", NULL};
  switch (way) {
    case 0: execv("/bin/grep", words); break;
    case 1: execve("/bin/grep", words, environment); break;
    case 2: execvp("grep", words); break;
    case 3: execvpe("grep", words, environment); break;
    case 4: fexecve(open("/bin/grep", O_RDONLY), words, environment); break;
    case 5: execl("/bin/grep", words[0], words[1], words[2], words[3], (char*)NULL); break;
    case 6: execlp("grep", words[0], words[1], words[2], words[3], (char*)NULL); break;
    default: execle("/bin/grep", words[0], words[1], words[2], words[3], (char*)NULL, environment); break;
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

// Others that start programs.

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
  char* const words[] = {"grep", "-q", "SigBlk:.*200$", "/proc/self/status", NULL};
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGUSR1);
  sigprocmask(SIG_BLOCK, &set, NULL);
  pid_t child = 0;
  EXPECT_IS(posix_spawn(&child, "/bin/grep", NULL, NULL, words, environment), 0);
  EXPECT_EXIT(child, 0);
  EXPECT_IS(posix_spawnp(&child, "grep", NULL, NULL, words, environment), 0);
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
CASE(vfork_waits_until_the_child_is_another) {
  const pid_t child = vfork();
  if (child == 0) {
    execv("/bin/sh", say_11);
    _exit(1);
  }
  EXPECT_EXIT(child, 11);
}
CASE(vfork_waits_until_the_child_has_ended) {
  volatile int* const word = shared();
  const pid_t child = vfork();
  if (child == 0) {
    *word = 1;
    _exit(17);
  }
  EXPECT_IS(*word, 1);
  EXPECT_EXIT(child, 17);
}
CASE(_Fork_calls_no_handlers) {
  extern void note_prepare(void);
  EXPECT_IS(pthread_atfork(note_prepare, NULL, NULL), 0);
  const pid_t child = _Fork();
  if (child == 0) _exit(gettid() == getpid() ? 3 : 4);
  EXPECT_EXIT(child, 3);
  EXPECT_NOTED("");
}

// Handlers of fork.

void note_prepare(void);
void note_prepare(void) { note("a"); }
static void note_parent(void) { note("b"); }
static void note_child(void) { note("c"); }
static void note_prepare_2(void) { note("A"); }
static void note_parent_2(void) { note("B"); }
static void note_child_2(void) { note("C"); }
CASE(handlers_of_fork_are_called_in_their_order) {
  EXPECT_IS(pthread_atfork(note_prepare, note_parent, note_child), 0);
  EXPECT_IS(pthread_atfork(note_prepare_2, note_parent_2, note_child_2), 0);
  const pid_t child = fork();
  if (child == 0) {
    EXPECT_NOTED("AacC");
    _exit(0);
  }
  EXPECT_NOTED("AabB");
  EXPECT_EXIT(child, 0);
}
static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static void lock_it(void) { pthread_mutex_lock(&mutex); }
static void unlock_it(void) { pthread_mutex_unlock(&mutex); }
static void* use_mutex(void* unused) {
  for (int i = 0; i < 200; ++i) {
    pthread_mutex_lock(&mutex);
    if (i % 10 == 0) sleep_ms(1);
    pthread_mutex_unlock(&mutex);
    sched_yield();
  }
  return unused;
}
CASE(a_mutex_can_be_kept_free_for_children) {
  EXPECT_IS(pthread_atfork(lock_it, unlock_it, unlock_it), 0);
  const pthread_t id = start(use_mutex, NULL);
  for (int i = 0; i < 3; ++i) {
    sleep_ms(1);
    const pid_t child = fork();
    if (child == 0) {
      EXPECT_IS(pthread_mutex_lock(&mutex), 0);
      EXPECT_IS(pthread_mutex_unlock(&mutex), 0);
      _exit(0);
    }
    EXPECT_EXIT(child, 0);
  }
  join(id);
}

// Ends.

static int report = -1;
static void tell(const char* letter) {
  if (write(report, letter, 1) != 1) _exit(99);
}
static void tell_a(void) { tell("a"); }
static void tell_b(void) { tell("b"); }
static void* exit_with_18(void* unused) {
  (void)unused;
  exit(18);
}
static void* _exit_with_19(void* unused) {
  (void)unused;
  _exit(19);
}
static void expect_end(const char* file, int line, void* (*end)(void*), int status, const char* told) {
  int ends[2];
  EXPECT_IS(pipe(ends), 0);
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    report = ends[1];
    atexit(tell_a);
    atexit(tell_b);
    at_quick_exit(tell_b);
    at_quick_exit(tell_a);
    start(end, NULL);
    for (;;) sleep(1);
  }
  close(ends[1]);
  expect_exit(file, line, child, status);
  char text[8] = "";
  expect_equal(file, line, "told", read(ends[0], text, 7), (long long)strlen(told));
  expect_equal(file, line, told, strcmp(text, told), 0);
}
#define EXPECT_END(end, status, told) expect_end(__FILE__, __LINE__, end, status, told)
static void* quick_exit_with_20(void* unused) {
  (void)unused;
  quick_exit(20);
}
static void* _Exit_with_22(void* unused) {
  (void)unused;
  _Exit(22);
}
CASE(exit_in_a_thread_calls_handlers_last_first) { EXPECT_END(exit_with_18, 18, "ba"); }
CASE(_exit_in_a_thread_calls_none) { EXPECT_END(_exit_with_19, 19, ""); }
CASE(quick_exit_in_a_thread_calls_its_own) { EXPECT_END(quick_exit_with_20, 20, "ab"); }
CASE(_Exit_in_a_thread_calls_none) { EXPECT_END(_Exit_with_22, 22, ""); }
static void exit_again(void) { _exit(23); }
CASE_ENDING_WITH(23, a_handler_of_exit_may_end_with_another_status) {
  atexit(exit_again);
  exit(1);
}
CASE(what_was_printed_is_written_at_exit) {
  int ends[2];
  EXPECT_IS(pipe(ends), 0);
  const pid_t child = fork();
  if (child == 0) {
    dup2(ends[1], 1);
    printf("printed");
    exit(0);
  }
  EXPECT_EXIT(child, 0);
  char text[16] = "";
  EXPECT_IS(read(ends[0], text, 15), 7);
}
