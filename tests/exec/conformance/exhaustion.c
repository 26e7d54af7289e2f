// SPDX-License-Identifier: BSD-3-Clause
// Programs that have exhausted their memory: primitives need none, and calls that do fail with ENOMEM or EAGAIN.
#include "tests/exec/conformance/harness.h"

#include <semaphore.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>

/// All address space that is left, in as few mappings as possible.
static void exhaust_addresses(void) {
  for (size_t size = (size_t)1 << 46; size >= 4096; size /= 2)
    while (mmap(NULL, size, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0) != MAP_FAILED) continue;
  EXPECT_IS(errno, ENOMEM);
}
static void limit_addresses(void) {
  struct rlimit limit;
  EXPECT_IS(getrlimit(RLIMIT_AS, &limit), 0);
  limit.rlim_cur = 4096;
  EXPECT_IS(setrlimit(RLIMIT_AS, &limit), 0);
}
/// Neighbours of different protection are not joined.
static void exhaust_mappings(void) {
  for (int i = 0;; ++i)
    if (mmap(NULL, 4096, i % 2 == 0 ? PROT_READ : PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) == MAP_FAILED) break;
  EXPECT_IS(errno, ENOMEM);
}

enum { many = 20000 };
static pthread_mutex_t mutexes[many];
static pthread_cond_t conditions[many];
static pthread_rwlock_t locks[many];
static sem_t semaphores[many];
static pthread_spinlock_t spin_locks[many];
static void use_primitives(void) {
  for (int i = 0; i < many; ++i) {
    EXPECT_IS(pthread_mutex_init(&mutexes[i], NULL), 0);
    EXPECT_IS(pthread_mutex_lock(&mutexes[i]), 0);
    EXPECT_IS(pthread_cond_init(&conditions[i], NULL), 0);
    EXPECT_IS(pthread_cond_signal(&conditions[i]), 0);
    EXPECT_IS(pthread_rwlock_init(&locks[i], NULL), 0);
    EXPECT_IS(pthread_rwlock_rdlock(&locks[i]), 0);
    EXPECT_IS(sem_init(&semaphores[i], 0, 0), 0);
    EXPECT_IS(sem_post(&semaphores[i]), 0);
    EXPECT_IS(pthread_spin_init(&spin_locks[i], PTHREAD_PROCESS_PRIVATE), 0);
    EXPECT_IS(pthread_spin_lock(&spin_locks[i]), 0);
  }
}
CASE(primitives_need_no_address_space) {
  exhaust_addresses();
  use_primitives();
}
CASE(primitives_need_no_address_space_within_the_limit) {
  limit_addresses();
  use_primitives();
}
CASE(primitives_need_no_mappings) {
  exhaust_mappings();
  use_primitives();
}
CASE(without_address_space_a_fork_fails_or_not) {
  limit_addresses();
  const pid_t child = fork();
  if (child == 0) _exit(0);
  if (child < 0)
    EXPECT(errno == ENOMEM || errno == EAGAIN);
  else
    EXPECT_IS(waitpid(child, NULL, 0), child);
}
static void* end(void* unused) { return unused; }
CASE(without_address_space_a_thread_is_refused_or_not) {
  limit_addresses();
  pthread_t id;
  const int error = pthread_create(&id, NULL, end, NULL);
  EXPECT(error == 0 || error == EAGAIN);
  if (error == 0) join(id);
}
