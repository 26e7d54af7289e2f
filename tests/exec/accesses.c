// SPDX-License-Identifier: BSD-3-Clause
//
// accesses CASE: two threads share memory without an instrumented access. The first cases are correct, though what they
// do is hard on breakpoints: exit status 0 in each schedule. The last ones fail if the threads are switched between two
// accesses.
#define _GNU_SOURCE
#include <pthread.h>
#include <setjmp.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <ucontext.h>
#include <unistd.h>

enum { rounds = 4, page = 4096 };

static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static int counted, handled, lock;

static void count(void) {
  pthread_mutex_lock(&mutex);
  ++counted;
  pthread_mutex_unlock(&mutex);
}

static void note(int signal) {
  (void)signal;
  __atomic_fetch_add(&handled, 1, __ATOMIC_SEQ_CST);
}

static void* count_and_note(void* none) {
  for (int i = 0; i < rounds; ++i) {
    __atomic_fetch_add(&handled, 1, __ATOMIC_SEQ_CST);
    count();
  }
  return none;
}

// Signals are handled where threads access memory.
static int signals(void) {
  pthread_t threads[2];
  signal(SIGUSR1, note);
  for (int i = 0; i < 2; ++i) pthread_create(&threads[i], NULL, count_and_note, NULL);
  const int sent = pthread_kill(threads[0], SIGUSR1) == 0;
  for (int i = 0; i < 2; ++i) pthread_join(threads[i], NULL);
  return counted == 2 * rounds && handled >= 2 * rounds && handled <= 2 * rounds + sent;
}

// The processor's own signal is raised by an access.
static __thread sigjmp_buf back;
static volatile int zero;
static void jump_back(int signal) { siglongjmp(back, signal); }
static void* divide(void* none) {
  for (int i = 0; i < rounds; ++i) {
    if (sigsetjmp(back, 1) != 0) {
      count();
      continue;
    }
    pthread_mutex_lock(&mutex);
    zero = 0;
    pthread_mutex_unlock(&mutex);
    int result;
    __asm__ volatile("xorl %%edx, %%edx; movl $1, %%eax; divl %1" : "=&a"(result) : "m"(zero) : "rdx", "cc");
  }
  return none;
}

// A handler on a stack of its own.
static void* count_with_own_stack(void* none) {
  stack_t stack = {.ss_sp = malloc(64 << 10), .ss_size = 64 << 10};
  sigaltstack(&stack, NULL);
  for (int i = 0; i < rounds; ++i) {
    raise(SIGUSR2);
    count();
  }
  return none;
}

// Coroutines on stacks of four kilobytes, full almost to the end.
static __thread ucontext_t outer, inner;
static void compute_within(void) {
  for (int i = 0; i < rounds; ++i) {
    char room[2500];
    memset(room, i, sizeof room);
    count();
    for (size_t k = 0; k < sizeof room; ++k)
      if (room[k] != (char)i) abort();
    swapcontext(&inner, &outer);
  }
}
static void* switch_contexts(void* none) {
  char* const memory = mmap(NULL, 2 * page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  memset(memory, 1, page);
  getcontext(&inner);
  inner.uc_stack.ss_sp = memory + page;
  inner.uc_stack.ss_size = page;
  inner.uc_link = &outer;
  makecontext(&inner, compute_within, 0);
  for (int i = 0; i < rounds; ++i) swapcontext(&outer, &inner);
  for (int k = 0; k < page; ++k)
    if (memory[k] != 1) abort();
  return none;
}

// A lock that waits for its release by reading.
static void* count_under_spin_lock(void* none) {
  for (int i = 0; i < rounds; ++i) {
    while (__atomic_exchange_n(&lock, 1, __ATOMIC_ACQUIRE))
      while (__atomic_load_n(&lock, __ATOMIC_RELAXED)) __builtin_ia32_pause();
    ++counted;
    __atomic_store_n(&lock, 0, __ATOMIC_RELEASE);
  }
  return none;
}

// Bits far from the operand's own address, each word under a lock of its own.
static unsigned long bits[2];
static pthread_mutex_t locks[2] = {PTHREAD_MUTEX_INITIALIZER, PTHREAD_MUTEX_INITIALIZER};
static void* set_bits(void* which) {
  const long word = (long)which;
  for (long i = 0; i < rounds; ++i) {
    pthread_mutex_lock(&locks[word]);
    __asm__ volatile("btsq %1, %0" : "+m"(bits) : "r"(word * 64 + i) : "cc", "memory");
    pthread_mutex_unlock(&locks[word]);
    count();
  }
  return NULL;
}

// The code is read as data, and changed.
__attribute__((noinline, aligned(64))) static int summed(int value) { return (counted += value) + zero; }
static unsigned sum_of_code(void) {
  unsigned sum = 0;
  for (int i = 0; i < 32; ++i) sum += ((const volatile unsigned char*)(uintptr_t)summed)[i] * (unsigned)(i + 1);
  return sum;
}
static unsigned right_sum;
static void* sum_code(void* none) {
  for (int i = 0; i < rounds; ++i) {
    pthread_mutex_lock(&mutex);
    summed(1);
    pthread_mutex_unlock(&mutex);
    if (sum_of_code() != right_sum) abort();
  }
  return none;
}
static void* rewrite_code(void* none) {
  char* const code = (char*)((uintptr_t)summed & ~(uintptr_t)(page - 1));
  char copy[64];
  pthread_mutex_lock(&mutex);
  summed(1);
  mprotect(code, 2 * page, PROT_READ | PROT_WRITE | PROT_EXEC);
  memcpy(copy, (const void*)(uintptr_t)summed, sizeof copy);
  memcpy((void*)(uintptr_t)summed, copy, sizeof copy);
  mprotect(code, 2 * page, PROT_READ | PROT_EXEC);
  summed(rounds - 1);
  pthread_mutex_unlock(&mutex);
  return none;
}

static void* count_unlocked(void* none) {
  for (int i = 0; i < rounds; ++i) ++counted;
  return none;
}

// Copied there and back by string instructions.
static int counts[16];
static void copy(void* to, const void* from) {
  unsigned long size = sizeof counts;
  __asm__ volatile("rep movsb" : "+D"(to), "+S"(from), "+c"(size) : : "memory");
}
static void* count_in_copy(void* none) {
  int own[16];
  for (int i = 0; i < rounds; ++i) {
    copy(own, counts);
    ++own[15];
    copy(counts, own);
  }
  counted = counts[15];
  return none;
}

// An unlocked update behind an instruction that has an operand in memory, but accesses nothing.
static void* count_after_padding(void* none) {
  for (int i = 0; i < rounds; ++i) {
    __asm__ volatile("nopl (%%rax)" : : "a"(0L) : "memory");
    ++counted;
  }
  return none;
}

// One waits for the other without a call.
static volatile int arrived;
static void* count_in_turn(void* number) {
  while (arrived != (int)(long)number) {
  }
  counted += rounds;
  ++arrived;
  return NULL;
}
static void* count_in_reverse_turn(void* number) { return count_in_turn((void*)(1 - (long)number)); }

static int both(void* (*body)(void*)) {
  pthread_t threads[2];
  for (long i = 0; i < 2; ++i) pthread_create(&threads[i], NULL, body, (void*)i);
  for (int i = 0; i < 2; ++i) pthread_join(threads[i], NULL);
  return counted == 2 * rounds;
}

static int is_right(const char* what) {
  struct sigaction on_stack = {.sa_handler = note, .sa_flags = SA_ONSTACK};
  if (strcmp(what, "signals") == 0) return signals();
  if (strcmp(what, "faults") == 0) return signal(SIGFPE, jump_back) != SIG_ERR && both(divide);
  if (strcmp(what, "own stacks") == 0) return sigaction(SIGUSR2, &on_stack, NULL) == 0 && both(count_with_own_stack);
  if (strcmp(what, "contexts") == 0) return both(switch_contexts);
  if (strcmp(what, "spin lock") == 0) return both(count_under_spin_lock);
  if (strcmp(what, "bits") == 0) return both(set_bits) && bits[0] == 15 && bits[1] == 15;
  if (strcmp(what, "traps") == 0) return signal(SIGTRAP, note) != SIG_ERR && both(count_and_note);
  if (strcmp(what, "sum of code") == 0) return (right_sum = sum_of_code()) != 0 && both(sum_code);
  if (strcmp(what, "changed code") == 0) return both(rewrite_code);
  if (strcmp(what, "turns") == 0) return both(count_in_reverse_turn);
  if (strcmp(what, "padding") == 0) return both(count_after_padding);
  if (strcmp(what, "update") == 0) return both(count_unlocked);
  if (strcmp(what, "copies") == 0) return both(count_in_copy) || counts[15] == 2 * rounds;
  return 0;
}

int main(int count, char** words) { return count == 2 && is_right(words[1]) ? 0 : 1; }
