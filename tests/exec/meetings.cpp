// SPDX-License-Identifier: BSD-3-Clause
//
// Two threads use a plain variable, before and after synchronising by the means that the argument names: no race.
// Without an argument, lists the names.
#include <pthread.h>
#include <semaphore.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <threads.h>
#include <unistd.h>

#include <atomic>
#include <barrier>
#include <cerrno>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <future>
#include <latch>
#include <memory>
#include <mutex>
#include <semaphore>
#include <shared_mutex>
#include <string>
#include <thread>

namespace {

int seen = 0;

void see() { ++seen; }

template <class First, class Second>
void run(First first, Second second) {
  std::thread one(first), other(second);
  one.join();
  other.join();
}

template <class Both>
void run(Both both) {
  run(both, both);
}

/// One thread reads, then tells the other, which waits for it.
template <class Tell, class Wait>
void pass_on(Tell tell, Wait wait) {
  run([&] { see(), tell(); }, [&] { wait(), see(); });
}

template <class Lock, class Unlock>
void exclude(Lock lock, Unlock unlock) {
  run([&] { lock(), see(), unlock(); });
}

void by_descriptors(int from, int to) {
  std::uint64_t word = 1;
  pass_on([&] { (void)!write(to, &word, sizeof word); },
          [&] {
            std::uint64_t other = 0;
            (void)!read(from, &other, sizeof other);
          });
}

int made_once() {
  static const int made = ++seen;
  return made;
}

struct {
  const char* name;
  std::function<void()> run;
} const meetings[] = {
    {"condition",
     [] {
       std::mutex mutex;
       std::condition_variable condition;
       bool told = false;
       run(
           [&] {
             const std::lock_guard guard(mutex);
             see();
             told = true;
             condition.notify_one();
           },
           [&] {
             std::unique_lock guard(mutex);
             see();
             condition.wait(guard, [&] { return told; });
             see();
           });
     }},
    {"once",
     [] {
       static pthread_once_t once = PTHREAD_ONCE_INIT;
       std::atomic<int> right = 0;
       run([&] {
         pthread_once(&once, see);
         right += seen == 1;
       });
       if (right != 2) std::abort();
     }},
    {"call_once",
     [] {
       std::once_flag once;
       std::atomic<int> right = 0;
       run([&] {
         std::call_once(once, see);
         right += seen == 1;
       });
       if (right != 2) std::abort();
     }},
    {"static", [] { run([] { return made_once() + seen; }); }},
    {"robust mutex",
     [] {
       pthread_mutex_t mutex;
       pthread_mutexattr_t attributes;
       pthread_mutexattr_init(&attributes);
       pthread_mutexattr_setrobust(&attributes, PTHREAD_MUTEX_ROBUST);
       pthread_mutex_init(&mutex, &attributes);
       run([&] {
         if (pthread_mutex_lock(&mutex) == EOWNERDEAD) pthread_mutex_consistent(&mutex);
         see();
       });
     }},
    {"read-write lock",
     [] {
       std::shared_mutex mutex;
       run([&] {
         std::shared_lock reading(mutex);
         const int before = seen;
         reading.unlock();
         const std::lock_guard writing(mutex);
         seen += before >= 0;
       });
     }},
    {"spin lock",
     [] {
       pthread_spinlock_t lock;
       pthread_spin_init(&lock, PTHREAD_PROCESS_PRIVATE);
       exclude([&] { pthread_spin_lock(&lock); }, [&] { pthread_spin_unlock(&lock); });
     }},
    {"mutex of C11",
     [] {
       mtx_t mutex;
       mtx_init(&mutex, mtx_plain);
       exclude([&] { mtx_lock(&mutex); }, [&] { mtx_unlock(&mutex); });
     }},
    {"mutex that is tried",
     [] {
       std::mutex mutex;
       const auto lock = [&] {
         while (!mutex.try_lock()) std::this_thread::yield();
       };
       exclude(lock, [&] { mutex.unlock(); });
     }},
    {"barrier",
     [] {
       pthread_barrier_t barrier;
       pthread_barrier_init(&barrier, nullptr, 2);
       const auto wait = [&] { pthread_barrier_wait(&barrier); };
       pass_on(wait, wait);
     }},
    {"barrier of C++",
     [] {
       std::barrier barrier(2);
       const auto wait = [&] { barrier.arrive_and_wait(); };
       pass_on(wait, wait);
     }},
    {"latch",
     [] {
       std::latch latch(1);
       pass_on([&] { latch.count_down(); }, [&] { latch.wait(); });
     }},
    {"semaphore",
     [] {
       sem_t semaphore;
       sem_init(&semaphore, 0, 0);
       pass_on([&] { sem_post(&semaphore); }, [&] { sem_wait(&semaphore); });
     }},
    {"semaphore of C++",
     [] {
       std::binary_semaphore semaphore(0);
       pass_on([&] { semaphore.release(); }, [&] { semaphore.acquire(); });
     }},
    {"atomic",
     [] {
       std::atomic<bool> told = false;
       pass_on(
           [&] {
             told = true;
             told.notify_one();
           },
           [&] { told.wait(false); });
     }},
    {"future",
     [] {
       std::promise<std::string> promise;
       run([&] { promise.set_value("too long to be within the string"); },
           [&] { seen += static_cast<int>(promise.get_future().get().size()); });
     }},
    {"shared pointer", [] { run([mine = std::make_shared<int>(1)] { (void)*mine; }); }},
    {"pipe",
     [] {
       int ends[2];
       if (pipe(ends) == 0) by_descriptors(ends[0], ends[1]);
     }},
    {"sockets",
     [] {
       int ends[2];
       if (socketpair(AF_UNIX, SOCK_STREAM, 0, ends) == 0) by_descriptors(ends[0], ends[1]);
     }},
    {"eventfd",
     [] {
       const int counter = eventfd(0, 0);
       by_descriptors(counter, counter);
     }},
};

}  // namespace

int main(int argc, char** argv) {
  for (const auto& meeting : meetings) {
    if (argc == 1)
      std::puts(meeting.name);
    else if (std::strcmp(meeting.name, argv[1]) == 0)
      return meeting.run(), see(), 0;
  }
  return argc == 1 ? 0 : 2;
}
