// SPDX-License-Identifier: BSD-3-Clause
//
// Costs of thread calls, the same natively and simulated: calls WORKLOAD COUNT prints nanoseconds of real time per
// call.
#include <pthread.h>
#include <sched.h>
#include <semaphore.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <vector>

namespace {

pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
pthread_cond_t condition = PTHREAD_COND_INITIALIZER;
sem_t semaphore;
long count, turn;

// Real time despite simulated clocks: the instruction is not intercepted.
double now_ns() {
  struct timespec time;
  long result = SYS_clock_gettime;
  __asm__ volatile("syscall" : "+a"(result) : "D"(std::int64_t{CLOCK_MONOTONIC}), "S"(&time) : "rcx", "r11", "memory");
  return 1e9 * static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec);
}

void lock() {
  for (long i = 0; i < count; ++i) {
    pthread_mutex_lock(&mutex);
    pthread_mutex_unlock(&mutex);
  }
}

void* take_turns(void* which) {
  const long mine = which == nullptr ? 0 : 1;
  for (long i = 0; i < count / 2; ++i) {
    pthread_mutex_lock(&mutex);
    while (turn != mine) pthread_cond_wait(&condition, &mutex);
    turn = 1 - mine;
    pthread_cond_signal(&condition);
    pthread_mutex_unlock(&mutex);
  }
  return nullptr;
}

void hand_over() {
  pthread_t threads[2];
  for (long i = 0; i < 2; ++i) pthread_create(&threads[i], nullptr, take_turns, i == 0 ? nullptr : &turn);
  for (int i = 0; i < 2; ++i) pthread_join(threads[i], nullptr);
}

void* yield(void* unused) {
  for (long i = 0; i < count / 2; ++i) sched_yield();
  return unused;
}

void switch_threads() {
  pthread_t threads[2];
  for (int i = 0; i < 2; ++i) pthread_create(&threads[i], nullptr, yield, nullptr);
  for (int i = 0; i < 2; ++i) pthread_join(threads[i], nullptr);
}

void* do_nothing(void* unused) { return unused; }

void create() {
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

void sleepers() {
  pthread_t threads[4];
  for (int i = 0; i < 4; ++i) pthread_create(&threads[i], nullptr, sleep_two_hours, nullptr);
  for (int i = 0; i < 4; ++i) pthread_join(threads[i], nullptr);
}

void* wait_for_all(void* unused) {
  sem_wait(&semaphore);
  return unused;
}

void many() {
  std::vector<pthread_t> threads(static_cast<std::size_t>(count));
  sem_init(&semaphore, 0, 0);
  for (pthread_t& thread : threads)
    if (pthread_create(&thread, nullptr, wait_for_all, nullptr) != 0) std::exit(1);
  for (long i = 0; i < count; ++i) sem_post(&semaphore);
  for (const pthread_t thread : threads) pthread_join(thread, nullptr);
}

struct Workload {
  const char* name;
  void (*run)();
};
const Workload workloads[] = {{"lock", lock},     {"hand-over", hand_over}, {"switch", switch_threads},
                              {"create", create}, {"sleepers", sleepers},   {"many", many}};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  count = std::atol(argv[2]);
  for (const Workload& workload : workloads) {
    if (std::strcmp(argv[1], workload.name) != 0) continue;
    const double begin = now_ns();
    workload.run();
    std::printf("%.17g\n", (now_ns() - begin) / static_cast<double>(count));
    return 0;
  }
  return 2;
}
