// SPDX-License-Identifier: BSD-3-Clause
//
// Costs of calls, the same natively and simulated: calls WORKLOAD COUNT prints ticks of the processor's counter per
// call.
#include <pthread.h>
#include <sched.h>
#include <semaphore.h>
#include <unistd.h>
#include <x86intrin.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "tests/bench/exec/workloads.hpp"

namespace waitpoint::bench {
namespace {

pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
pthread_cond_t condition = PTHREAD_COND_INITIALIZER;
sem_t semaphore;
long turns, turn;  // of each thread; whose it is

void lock(long count) {
  for (long i = 0; i < count; ++i) {
    pthread_mutex_lock(&mutex);
    pthread_mutex_unlock(&mutex);
  }
}

void* take_turns(void* which) {
  const long mine = which == nullptr ? 0 : 1;
  for (long i = 0; i < turns; ++i) {
    pthread_mutex_lock(&mutex);
    while (turn != mine) pthread_cond_wait(&condition, &mutex);
    turn = 1 - mine;
    pthread_cond_signal(&condition);
    pthread_mutex_unlock(&mutex);
  }
  return nullptr;
}

void hand_over(long count) {
  turns = count / 2;
  pthread_t threads[2];
  for (long i = 0; i < 2; ++i) pthread_create(&threads[i], nullptr, take_turns, i == 0 ? nullptr : &turn);
  for (int i = 0; i < 2; ++i) pthread_join(threads[i], nullptr);
}

void* yield(void* unused) {
  for (long i = 0; i < turns; ++i) sched_yield();
  return unused;
}

void switch_threads(long count) {
  turns = count / 2;
  pthread_t threads[2];
  for (int i = 0; i < 2; ++i) pthread_create(&threads[i], nullptr, yield, nullptr);
  for (int i = 0; i < 2; ++i) pthread_join(threads[i], nullptr);
}

void* do_nothing(void* unused) { return unused; }

void create(long count) {
  for (long i = 0; i < count; ++i) {
    pthread_t thread;
    pthread_create(&thread, nullptr, do_nothing, nullptr);
    pthread_join(thread, nullptr);
  }
}

void* sleep_two_hours(void* unused) {
  for (int i = 0; i < 7200; ++i) sleep(1);
  return unused;
}

void sleepers(long) {
  pthread_t threads[4];
  for (int i = 0; i < 4; ++i) pthread_create(&threads[i], nullptr, sleep_two_hours, nullptr);
  for (int i = 0; i < 4; ++i) pthread_join(threads[i], nullptr);
}

void* wait_for_all(void* unused) {
  sem_wait(&semaphore);
  return unused;
}

void many(long count) {
  std::vector<pthread_t> threads(static_cast<std::size_t>(count));
  sem_init(&semaphore, 0, 0);
  for (pthread_t& thread : threads)
    if (pthread_create(&thread, nullptr, wait_for_all, nullptr) != 0) std::exit(1);
  for (long i = 0; i < count; ++i) sem_post(&semaphore);
  for (const pthread_t thread : threads) pthread_join(thread, nullptr);
}

// A small program, for the exploration of schedules.
void* lock_three_times(void* argument) {
  lock(3);
  return argument;
}
void three_threads(long count) {
  for (long i = 0; i < count; ++i) {
    pthread_t threads[3];
    for (pthread_t& thread : threads) pthread_create(&thread, nullptr, lock_three_times, nullptr);
    for (const pthread_t thread : threads) pthread_join(thread, nullptr);
  }
}

const Workload workloads[] = {
    {"lock", lock},
    {"hand-over", hand_over},
    {"switch", switch_threads},
    {"create", create},
    {"sleepers", sleepers},
    {"many", many},
    {"processes-semaphores", hand_over_by_semaphores},
    {"processes-pipes", hand_over_by_pipes},
    {"processes-tcp", hand_over_by_tcp},
    {"pipe", write_and_read},
    {"threads-pipes", hand_over_by_pipes_of_threads},
    {"threads-socket-pair", hand_over_by_socket_pair},
    {"three", three_threads},
    {"fork", fork_and_wait},
    {"spawn", spawn_and_wait},
};

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const long count = std::atol(argv[2]);
  for (const Workload& workload : workloads) {
    if (std::strcmp(argv[1], workload.name) != 0) continue;
    // Real although the clocks are simulated: the instruction is not trapped without an option.
    const unsigned long long begin = __rdtsc();
    workload.run(count);
    std::printf("%.17g\n", static_cast<double>(__rdtsc() - begin) / static_cast<double>(count));
    return 0;
  }
  return 2;
}

}  // namespace
}  // namespace waitpoint::bench

int main(int argc, char** argv) { return waitpoint::bench::main(argc, argv); }
