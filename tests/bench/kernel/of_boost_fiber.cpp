// SPDX-License-Identifier: BSD-3-Clause
// The workloads on Boost.Fiber, with a virtual clock below its scheduler: when no fiber is ready, the one with the
// earliest deadline becomes ready. All else is the library's own.
//
// The library has no semaphores: one is a count and a condition variable, without a mutex, as only one thread runs.
// Timeouts are the library's, in real time.
#include <boost/fiber/all.hpp>
#include <queue>

#include "tests/bench/kernel/workloads.hpp"

namespace waitpoint::bench {
namespace {

namespace fibers = boost::fibers;

class VirtualClock : public fibers::algo::algorithm {
 public:
  static VirtualClock* current;

  void sleep(std::int64_t ns) {
    if (ready_.empty() && (sleepers_.empty() || now_ + ns < sleepers_.top().due)) {
      now_ += ns;  // no other is due earlier: a fiber cannot switch to itself
      return;
    }
    sleepers_.push({now_ + ns, sequence_++, fibers::context::active()});
    fibers::context::active()->suspend();
  }

  // The dispatcher only frees ended fibers and asks for the time: it runs when nothing else is ready.
  void awakened(fibers::context* context) noexcept override {
    if (context->is_context(fibers::type::dispatcher_context))
      dispatcher_ = context;
    else
      context->ready_link(ready_);
  }
  fibers::context* pick_next() noexcept override {
    if (!ready_.empty()) {
      fibers::context* next = &ready_.front();
      ready_.pop_front();
      return next;
    }
    if (sleepers_.empty()) return dispatcher_;
    const Sleeper next = sleepers_.top();
    sleepers_.pop();
    now_ = next.due;
    return next.context;
  }
  bool has_ready_fibers() const noexcept override { return !ready_.empty() || !sleepers_.empty(); }
  void suspend_until(const std::chrono::steady_clock::time_point&) noexcept override {}
  void notify() noexcept override {}

 private:
  struct Sleeper {
    std::int64_t due;
    std::uint64_t sequence;
    fibers::context* context;
    friend bool operator<(const Sleeper& a, const Sleeper& b) {  // the queue's greatest is the next
      return a.due != b.due ? a.due > b.due : a.sequence > b.sequence;
    }
  };

  std::priority_queue<Sleeper> sleepers_;
  fibers::scheduler::ready_queue_type ready_{};
  fibers::context* dispatcher_ = nullptr;
  std::int64_t now_ = 0;
  std::uint64_t sequence_ = 0;
};
VirtualClock* VirtualClock::current = nullptr;

struct NoLock {
  void lock() {}
  void unlock() {}
};

struct Kit {
  static constexpr Clock clock = Clock::processor;

  template <class Body>
  static void spawn(int, int, Body body) {
    fibers::fiber(fibers::launch::post, std::allocator_arg, fibers::fixedsize_stack(0x4000), std::move(body)).detach();
  }
  static void sleep(std::int64_t ns) { VirtualClock::current->sleep(ns); }

  struct Semaphore {
    explicit Semaphore(int units) : count(units) {}
    void acquire() {
      while (count == 0) released.wait(no_lock);
      --count;
    }
    bool acquire_for(std::int64_t ns) {
      if (count == 0) released.wait_for(no_lock, std::chrono::nanoseconds(ns));
      if (count == 0) return false;
      --count;
      return true;
    }
    void release() {
      ++count;
      released.notify_one();
    }
    int count;
    NoLock no_lock;
    fibers::condition_variable_any released;
  };
  using Signal = Semaphore;
  using Mutex = fibers::mutex;
  struct Condition {
    void wait(Mutex& held) {
      std::unique_lock<Mutex> lock(held, std::adopt_lock);
      variable.wait(lock);
      lock.release();
    }
    void notify() { variable.notify_one(); }
    fibers::condition_variable variable;
  };
};

void run(const Request& request) {
  VirtualClock::current = new VirtualClock;  // the scheduler owns it
  fibers::context::active()->get_scheduler()->set_algo(VirtualClock::current);
  carry_out<Kit>(request);
  leave();
}

}  // namespace
}  // namespace waitpoint::bench

int main(int argc, char** argv) { waitpoint::bench::run(waitpoint::bench::parse_request(argc, argv)); }
