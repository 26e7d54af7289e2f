// SPDX-License-Identifier: BSD-3-Clause
// The workloads on system threads. Sleeping tasks use virtual time: one thread runs at a time and hands over to the
// next due one by its condition variable. The other workloads are plain code with sem_t, std::mutex and
// std::condition_variable, without virtual time.
#include <semaphore.h>
#include <unistd.h>

#include <condition_variable>
#include <mutex>
#include <queue>
#include <system_error>
#include <thread>

#include "tests/bench/kernel/workloads.hpp"

namespace waitpoint::bench {
namespace {

struct RealKit {
  static constexpr Clock clock = Clock::wall;

  template <class Body>
  static void spawn(int, int, Body body) {
    try {
      std::thread(std::move(body)).detach();
    } catch (const std::system_error& error) {
      std::fprintf(stderr, "no further thread: %s\n", error.what());
      std::fflush(stderr);
      _exit(1);
    }
  }
  // Only the first thread sleeps, to let the others run.
  static void sleep(std::int64_t ns) {
    if (ns > step_ns) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }

  struct Semaphore {
    explicit Semaphore(unsigned units) { sem_init(&of, 0, units); }
    void acquire() {
      while (sem_wait(&of) != 0) {
      }
    }
    void release() { sem_post(&of); }
    sem_t of;
  };
  using Mutex = std::mutex;
  struct Condition {
    void wait(Mutex& held) {
      std::unique_lock<std::mutex> lock(held, std::adopt_lock);
      variable.wait(lock);
      lock.release();
    }
    void notify() { variable.notify_one(); }
    std::condition_variable variable;
  };
};

/// A discrete-event simulation with threads: the running one holds the baton.
struct TurnsKit : RealKit {
  struct Turn {
    std::int64_t due;
    std::uint64_t sequence;
    std::condition_variable* thread;
    friend bool operator<(const Turn& a, const Turn& b) {  // the queue's greatest is the next
      return a.due != b.due ? a.due > b.due : a.sequence > b.sequence;
    }
  };
  static std::mutex baton;
  static std::priority_queue<Turn> turns;
  static std::condition_variable* next;
  static std::int64_t now;
  static std::uint64_t sequence;
  static std::size_t spawned;
  static thread_local std::condition_variable mine;

  template <class Body>
  static void spawn(int i, int tasks, Body body) {
    RealKit::spawn(i, tasks, [body = std::move(body), place = sequence++]() mutable {
      std::unique_lock<std::mutex> lock(baton);
      turns.push({now, place, &mine});
      mine.wait(lock, [] { return next == &mine; });
      lock.release();
      body();
    });
    ++spawned;
  }
  static void sleep(std::int64_t ns) {
    std::unique_lock<std::mutex> lock(baton, std::adopt_lock);
    while (turns.size() < spawned) {  // some have not reached the queue yet
      lock.unlock();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      lock.lock();
    }
    turns.push({now + ns, sequence++, &mine});
    const Turn least = turns.top();
    turns.pop();
    now = least.due;
    next = least.thread;
    if (next != &mine) {
      next->notify_one();
      mine.wait(lock, [] { return next == &mine; });
    }
    lock.release();
  }
};
std::mutex TurnsKit::baton;
std::priority_queue<TurnsKit::Turn> TurnsKit::turns;
std::condition_variable* TurnsKit::next = nullptr;
std::int64_t TurnsKit::now = 0;
std::uint64_t TurnsKit::sequence = 0;
std::size_t TurnsKit::spawned = 0;
thread_local std::condition_variable TurnsKit::mine;

void run(const Request& request) {
  const std::string& workload = request.workload;
  if (workload == "handover") {
    handover<RealKit>(request);
  } else if (workload == "buffer") {
    buffer<RealKit>(request);
  } else if (workload == "free mutex") {
    free_mutex<RealKit>(request);
  } else if (is_of_sleepers(workload)) {
    TurnsKit::baton.lock();
    sleepers<TurnsKit>(request);
  } else {
    decline();
  }
  leave();
}

}  // namespace
}  // namespace waitpoint::bench

int main(int argc, char** argv) { waitpoint::bench::run(waitpoint::bench::parse_request(argc, argv)); }
