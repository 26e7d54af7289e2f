// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fibers/sync/same_source.hpp"

#include <algorithm>
#include <deque>
#include <mutex>
#include <set>

#include "fibers/sync/threads.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;

struct Item {
  int producer = 0;
  int number = 0;
  static void fields(auto field) {
    field("producer", &Item::producer);
    field("number", &Item::number);
  }
};

void produce_and_consume(SameSourceOutcome& outcome) {
  threads::mutex mutex("buffer");
  threads::condition_variable filled("filled");
  threads::counting_semaphore<> room(4, "room");
  std::deque<Item> buffer;
  std::vector<threads::thread> all;
  for (int p = 0; p < 3; ++p)
    all.emplace_back(threads::thread_attributes{.name = "producer", .stack = kernel::StackSize::small}, [&, p] {
      for (int i = 0; i < 30; ++i) {
        room.acquire();
        threads::compute(10us);
        const std::lock_guard guard(mutex);
        buffer.push_back({p, i});
        threads::record(1, buffer.back());
        filled.notify_one();
      }
    });
  for (int c = 0; c < 3; ++c)
    all.emplace_back([&] {
      int last[3] = {-1, -1, -1};
      for (int i = 0; i < 30; ++i) {
        std::unique_lock lock(mutex);
        filled.wait(lock, [&] { return !buffer.empty(); });
        const Item item = buffer.front();
        buffer.pop_front();
        outcome.consumed.push_back(100 * item.producer + item.number);
        outcome.each_producer_in_order &= item.number > last[item.producer];
        last[item.producer] = item.number;
        lock.unlock();
        room.release();
        if (i % 10 == 0) threads::this_thread::yield();
      }
    });
  for (threads::thread& thread : all) thread.join();
  std::sort(outcome.consumed.begin(), outcome.consumed.end());
}

void tick(SameSourceOutcome& outcome) {
  const Duration period = 8ms;
  threads::periodic_timer timer(Period::every(period), 2ms, "ticks");
  outcome.ticks = timer.wait();
  const Time first = timer.due();
  outcome.times_were_kept &= first <= threads::now();
  while (outcome.ticks < 20) {
    outcome.ticks += timer.wait();
    outcome.times_were_kept &= timer.due() <= threads::now();
    if (outcome.first_dues.size() < 3) outcome.first_dues.push_back((timer.due() - first) / period);
  }
  threads::this_thread::sleep_until(timer.due() + period * 11 / 2);
  outcome.ticks_while_busy = timer.wait();
}

void time_out(SameSourceOutcome& outcome) {
  threads::timed_mutex held("held");
  threads::binary_semaphore empty(0);
  held.lock();
  threads::thread other([&] {
    const auto timed_out = [&](bool got, Time begin) {
      outcome.timeouts_came &= !got && threads::now() - begin >= Duration(3ms);
    };
    Time begin = threads::now();
    timed_out(held.try_lock_for(3ms), begin);
    begin = threads::now();
    timed_out(held.try_lock_until(threads::steady_clock::now() + 3ms), begin);
    begin = threads::now();
    timed_out(empty.try_acquire_for(3ms), begin);
    threads::mutex mutex;
    threads::condition_variable never;
    std::unique_lock lock(mutex);
    begin = threads::now();
    timed_out(never.wait_for(lock, 3ms, [] { return false; }), begin);
    begin = threads::now();
    timed_out(never.wait_until(lock, threads::steady_clock::now() + 3ms) != std::cv_status::timeout, begin);
  });
  other.join();
  held.unlock();
  outcome.timeouts_came &= held.try_lock() && !empty.try_acquire();
  held.unlock();
}

void sleep(SameSourceOutcome& outcome) {
  const auto at_least = [&](Duration span, auto wait) {
    const Time begin = threads::now();
    wait();
    outcome.times_were_kept &= threads::now() - begin >= span;
  };
  at_least(1ms, [] { threads::this_thread::sleep_for(1ms); });
  at_least(1ms, [] { threads::this_thread::sleep_for(std::chrono::duration<double>(1e-3)); });
  at_least(1ms, [] { threads::this_thread::sleep_for(Duration(1ms)); });
  at_least(1ms, [] { threads::this_thread::sleep_until(threads::now() + Duration(1ms)); });
  at_least(1ms, [] { threads::this_thread::sleep_until(threads::steady_clock::now() + 1ms); });
}

void start_threads(SameSourceOutcome& outcome) {
  threads::mutex mutex;
  std::set<decltype(threads::this_thread::get_id())> ids;
  std::vector<threads::thread> all;
  for (int i = 0; i < 5; ++i)
    all.emplace_back([&] {
      const std::lock_guard guard(mutex);
      ids.insert(threads::this_thread::get_id());
    });
  threads::thread moved = std::move(all.back());
  all.pop_back();
  for (threads::thread& thread : all) thread.join();
  moved.join();
  outcome.threads_with_own_id = static_cast<int>(ids.size());
}

}  // namespace

SameSourceOutcome run_same_source() {
  SameSourceOutcome outcome;
  produce_and_consume(outcome);
  tick(outcome);
  time_out(outcome);
  sleep(outcome);
  start_threads(outcome);
  return outcome;
}

}  // namespace waitpoint
