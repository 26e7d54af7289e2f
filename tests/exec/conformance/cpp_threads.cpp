// SPDX-License-Identifier: BSD-3-Clause
// C++ on these calls: the standard library's threads, and the needs of its run-time library.
#include "tests/exec/conformance/harness.h"

#include <atomic>
#include <barrier>
#include <chrono>
#include <condition_variable>
#include <future>
#include <latch>
#include <mutex>
#include <random>
#include <semaphore>
#include <shared_mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

using namespace std::chrono_literals;

CASE(threads_count_under_a_mutex) {
  std::mutex mutex;
  int counted = 0;
  std::vector<std::thread> threads;
  for (int i = 0; i < 8; ++i)
    threads.emplace_back([&] {
      for (int j = 0; j < 100; ++j) {
        const std::lock_guard lock(mutex);
        ++counted;
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_IS(counted, 800);
}
CASE(a_jthread_is_asked_to_stop_and_joined) {
  std::atomic<bool> stopped = false;
  {
    const std::jthread thread([&](const std::stop_token& token) {
      while (!token.stop_requested()) std::this_thread::yield();
      stopped = true;
    });
  }
  EXPECT(stopped);
}
CASE(ids_of_threads_differ) {
  std::thread::id id;
  std::thread([&] { id = std::this_thread::get_id(); }).join();
  EXPECT(id != std::this_thread::get_id());
}
CASE(there_is_a_processor) { EXPECT(std::thread::hardware_concurrency() >= 1); }
CASE(sleep_for_and_until_sleep_so_long) {
  const auto begin = std::chrono::steady_clock::now();
  std::this_thread::sleep_for(3ms);
  EXPECT(std::chrono::steady_clock::now() - begin >= 3ms);
  std::this_thread::sleep_until(begin + 6ms);
  EXPECT(std::chrono::steady_clock::now() - begin >= 6ms);
  std::this_thread::sleep_until(std::chrono::system_clock::now() + 1ms);
}
CASE(a_condition_waits_for_a_time) {
  std::mutex mutex;
  std::condition_variable condition;
  std::unique_lock lock(mutex);
  EXPECT(!condition.wait_for(lock, 3ms, [] { return false; }));
  EXPECT(condition.wait_until(lock, std::chrono::system_clock::now() + 2ms) == std::cv_status::timeout);
}
CASE(timed_mutexes_wait_for_a_time) {
  std::timed_mutex mutex;
  std::shared_timed_mutex shared;
  mutex.lock();
  shared.lock();
  std::thread([&] {
    EXPECT(!mutex.try_lock_for(2ms));
    EXPECT(!shared.try_lock_for(2ms));
    EXPECT(!shared.try_lock_shared_until(std::chrono::system_clock::now() + 2ms));
  }).join();
  mutex.unlock();
  shared.unlock();
}
CASE(a_shared_mutex_is_shared_by_readers) {
  std::shared_mutex mutex;
  mutex.lock_shared();
  std::thread([&] {
    EXPECT(mutex.try_lock_shared());
    EXPECT(!mutex.try_lock());
    mutex.unlock_shared();
  }).join();
  mutex.unlock_shared();
}
CASE(an_atomic_waits_for_another_value) {
  std::atomic<int> value = 0;
  std::atomic<long long> wide = 0;
  std::thread thread([&] {
    std::this_thread::sleep_for(2ms);
    value = 1;
    value.notify_one();
    std::this_thread::sleep_for(2ms);
    wide = 1;
    wide.notify_all();
  });
  value.wait(0);
  wide.wait(0);
  EXPECT_IS(value, 1);
  thread.join();
}
CASE(latches_barriers_and_semaphores_meet) {
  std::latch latch(3);
  std::barrier barrier(3);
  std::counting_semaphore<5> semaphore(0);
  std::atomic<int> arrived = 0;
  std::vector<std::thread> threads;
  for (int i = 0; i < 3; ++i)
    threads.emplace_back([&] {
      latch.arrive_and_wait();
      ++arrived;
      barrier.arrive_and_wait();
      EXPECT_IS(arrived, 3);
      semaphore.release();
    });
  for (int i = 0; i < 3; ++i) semaphore.acquire();
  EXPECT(!semaphore.try_acquire_for(1ms));
  for (std::thread& thread : threads) thread.join();
}
CASE(a_future_gets_the_value_or_the_exception) {
  EXPECT_IS(std::async(std::launch::async, [] { return 42; }).get(), 42);
  std::future<int> failed = std::async(std::launch::async, []() -> int { throw std::runtime_error("no"); });
  bool caught = false;
  try {
    failed.get();
  } catch (const std::runtime_error&) {
    caught = true;
  }
  EXPECT(caught);
}
CASE(a_future_waits_for_a_time) {
  std::promise<void> promise;
  std::future<void> future = promise.get_future();
  EXPECT(future.wait_for(2ms) == std::future_status::timeout);
  std::thread thread([&] { promise.set_value(); });
  future.wait();
  thread.join();
  EXPECT(future.wait_for(0ms) == std::future_status::ready);
}
CASE(call_once_tries_again_after_an_exception) {
  std::once_flag flag;
  int calls = 0;
  for (int i = 0; i < 3; ++i) {
    try {
      std::call_once(flag, [&] {
        if (++calls == 1) throw std::runtime_error("once more");
      });
    } catch (const std::runtime_error&) {
      EXPECT_IS(i, 0);
    }
  }
  EXPECT_IS(calls, 2);
}

static std::atomic<int> made;
struct Slow {
  Slow() {
    std::this_thread::sleep_for(3ms);
    ++made;
  }
};
static Slow& slow() {
  static Slow only;
  return only;
}
CASE(a_static_variable_is_made_once) {
  std::vector<std::jthread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([] {
      slow();
      EXPECT_IS(made, 1);
    });
}

struct Noted {
  explicit Noted(const char* what) : text(what) {}
  ~Noted() { note(text); }
  const char* text;
};
static thread_local Noted first("1");
static thread_local Noted second("2");
CASE(thread_local_variables_are_destroyed_in_reverse) {
  std::thread([] {
    EXPECT(first.text[0] == '1');
    EXPECT(second.text[0] == '2');
  }).join();
  EXPECT_NOTED("21");
}
static void* exit_with_frame(void*) {
  const Noted frame("frame ");
  EXPECT(first.text[0] == '1');
  pthread_exit(nullptr);
}
CASE(pthread_exit_destroys_frames_then_thread_local_variables) {
  join(start(exit_with_frame, nullptr));
  EXPECT_NOTED("frame 21");
}
static void* sleep_with_frame(void*) {
  const Noted frame("frame");
  try {
    sleep_ms(5000);
  } catch (...) {
    note("caught ");
    throw;
  }
  return nullptr;
}
CASE(cancellation_unwinds_frames) {
  const pthread_t id = start(sleep_with_frame, nullptr);
  let_others_wait();
  pthread_cancel(id);
  EXPECT(join(id) == PTHREAD_CANCELED);
  EXPECT_NOTED("caught frame");
}
CASE(exceptions_in_flight_are_each_threads_own) {
  std::vector<std::jthread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([i] {
      try {
        throw i;
      } catch (int value) {
        std::this_thread::yield();
        EXPECT_IS(value, i);
        try {
          throw;
        } catch (int again) {
          EXPECT_IS(again, i);
        }
      }
      EXPECT_IS(std::uncaught_exceptions(), 0);
    });
}
CASE_ENDING_WITH(-6, an_exception_that_leaves_a_thread_terminates) {
  std::thread([] { throw std::runtime_error("not caught"); }).join();
}
CASE(a_random_device_repeats_with_the_seed) {
  std::random_device device;
  printf("%u %u\n", device(), device());
}
CASE(condition_variable_any_is_notified) {
  std::condition_variable_any condition;
  std::shared_mutex mutex;
  bool ready = false;
  std::jthread thread([&] {
    const std::unique_lock lock(mutex);
    ready = true;
    condition.notify_all();
  });
  std::shared_lock<std::shared_mutex> shared(mutex);
  condition.wait(shared, [&] { return ready; });
}
