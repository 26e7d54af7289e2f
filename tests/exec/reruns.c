// SPDX-License-Identifier: BSD-3-Clause
//
// A program that changes all kinds of state of its process, and finds them as they are at the start of a process. Each
// that it does not find so makes its threads lock once more, which changes the run's digest. With an argument it
// opens descriptors ("pipe", "file"), does what cannot be undone ("fork", "spawn", "limit"), or fails in some schedules
// ("exit", "abort", "crash").
#include <fcntl.h>
#include <fenv.h>
#include <pthread.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#define PAGES 64

static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static int initialised = 7, zero[PAGES * 1024], changes;
static __thread int of_thread = 5;

static void expect(int holds) {
  if (holds) return;
  ++changes;
  for (int i = 0; i < changes; ++i) pthread_mutex_lock(&mutex), pthread_mutex_unlock(&mutex);
}

static void handle(int signal) { (void)signal; }

// Freed by the run: in a mapping of its own.
static char* from_before;
__attribute__((constructor)) static void begin(void) { from_before = memset(malloc(1 << 20), 9, 1 << 20); }

static void use_memory(void) {
  expect(from_before[0] == 9 && from_before[1000000] == 9);
  from_before[1000000] = 8;
  free(from_before);
  expect(initialised == 7);
  initialised = 8;
  for (int i = 0; i < PAGES * 1024; i += 1000) expect(zero[i] == 0), zero[i] = i + 1;
  static char* kept;
  expect(kept == NULL);
  kept = malloc(300000);
  memset(kept, 1, 300000);
  for (int i = 1; i < 40; ++i) {
    char* const piece = calloc(1, (size_t)i * 300);
    for (int j = 0; j < i * 300; ++j) expect(piece[j] == 0);
    memset(piece, i, (size_t)i * 300);
    if (i % 3 == 0) free(piece);
  }
  int* const pages = mmap(NULL, 1 << 20, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  expect(pages[1000] == 0 && pages[200000] == 0);
  pages[1000] = pages[200000] = 1;
  // The address of a mapping, and the end of the heap, are part of the state, too.
  for (unsigned i = 0; i < ((uintptr_t)pages >> 12) % 5 + ((uintptr_t)sbrk(0) >> 12) % 3; ++i)
    pthread_mutex_lock(&mutex), pthread_mutex_unlock(&mutex);
}

static void use_process(void) {
  struct sigaction before;
  sigaction(SIGUSR1, NULL, &before);
  expect(before.sa_handler == SIG_DFL);
  signal(SIGUSR1, handle);
  raise(SIGUSR1);
  sigset_t set;
  sigemptyset(&set);
  pthread_sigmask(SIG_SETMASK, NULL, &set);
  expect(!sigismember(&set, SIGUSR2));
  sigaddset(&set, SIGUSR2);
  pthread_sigmask(SIG_SETMASK, &set, NULL);
  expect(fegetround() == FE_TONEAREST);
  fesetround(FE_UPWARD);
  char line[16] = "";
  expect(fgets(line, sizeof line, stdin) != NULL && strcmp(line, "first\n") == 0);
  expect(ftell(stdout) <= 0);
  printf("some output\n");
}

static void* work(void* unused) {
  expect(of_thread == 5);
  of_thread = 6;
  char* const piece = malloc(1000);
  for (int i = 0; i < 3; ++i) {
    pthread_mutex_lock(&mutex);
    ++zero[1];
    pthread_mutex_unlock(&mutex);
  }
  free(piece);
  return unused;
}

static void do_for_good(const char* what) {
  if (strcmp(what, "fork") == 0) {
    const pid_t child = fork();
    if (child == 0) _exit(0);
    waitpid(child, NULL, 0);
  }
  int ends[2];
  if (strcmp(what, "pipe") == 0) expect(pipe(ends) == 0 && ends[0] == 3);
  if (strcmp(what, "file") == 0) {
    FILE* const file = fopen("/dev/null", "r");
    expect(file != NULL && fileno(file) == 3 && getc(file) == EOF);
    expect(open("/dev/null", O_RDONLY) == 4);
  }
  if (strcmp(what, "spawn") == 0) expect(system("true") == 0);
  if (strcmp(what, "limit") == 0) {
    struct rlimit limit;
    expect(getrlimit(RLIMIT_NOFILE, &limit) == 0 && limit.rlim_cur != 100);
    limit.rlim_cur = 100;
    setrlimit(RLIMIT_NOFILE, &limit);
  }
  const int is_seldom = zero[1] % 2 == 0;
  if (strcmp(what, "exit") == 0 && is_seldom) exit(3);
  if (strcmp(what, "abort") == 0 && is_seldom) abort();
  if (strcmp(what, "crash") == 0 && is_seldom) *(volatile int*)0 = 1;
}

int main(int argc, char** argv) {
  use_memory();
  use_process();
  pthread_t threads[3];
  for (int i = 0; i < 3; ++i) pthread_create(&threads[i], NULL, work, NULL);
  pthread_mutex_lock(&mutex);
  if (argc > 1) do_for_good(argv[1]);
  pthread_mutex_unlock(&mutex);
  for (int i = 0; i < 3; ++i) pthread_join(threads[i], NULL);
  expect(of_thread == 5);
  of_thread = 6;
  return 0;
}
