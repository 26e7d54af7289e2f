// SPDX-License-Identifier: BSD-3-Clause
// A test that a user's own queue behaves as a sequential one, whatever the order of its tasks: linearizability.
#include <gtest/gtest.h>

#include <deque>
#include <mutex>
#include <optional>
#include <ostream>
#include <string>
#include <waitpoint/fibers/explore/explore.hpp>
#include <waitpoint/fibers/explore/linearizable.hpp>
#include <waitpoint/fibers/sync/threads.hpp>

namespace {

namespace threads = waitpoint::threads;  // the code under test uses this name instead of std

// The code under test. pop() looks and removes under two locks.
class SharedQueue {
 public:
  void push(int value) {
    const std::lock_guard lock(mutex_);
    values_.push_back(value);
  }
  std::optional<int> pop() {
    const std::optional<int> first = look();
    const std::lock_guard lock(mutex_);
    if (first && !values_.empty()) values_.pop_front();
    return first;
  }
  std::optional<int> pop_at_once() {
    const std::lock_guard lock(mutex_);
    if (values_.empty()) return std::nullopt;
    const int first = values_.front();
    values_.pop_front();
    return first;
  }

 private:
  std::optional<int> look() {
    const std::lock_guard lock(mutex_);
    return values_.empty() ? std::nullopt : std::optional(values_.front());
  }

  threads::mutex mutex_;
  std::deque<int> values_;
};

// The model: a sequential queue.
struct Fifo {
  struct Operation {
    std::string name;
    int value = 0;
    friend std::ostream& operator<<(std::ostream& out, const Operation& operation) {
      return operation.name == "push" ? out << "push " << operation.value : out << operation.name;
    }
  };
  using Result = std::optional<int>;

  Result apply(const Operation& operation) {
    if (operation.name == "push") return values.push_back(operation.value), std::nullopt;
    if (values.empty()) return std::nullopt;
    const int first = values.front();
    values.pop_front();
    return first;
  }
  bool operator==(const Fifo&) const = default;

  std::deque<int> values;
};

// Two tasks push, two pop.
void use(std::optional<int> (SharedQueue::*pop)()) {
  SharedQueue queue;
  waitpoint::History<Fifo> history;
  const auto push_one = [&](int value) { history.record({"push", value}, [&] { queue.push(value); }); };
  const auto pop_one = [&] { history.record({"pop"}, [&] { return (queue.*pop)(); }); };
  {
    threads::jthread a([&] { push_one(1); }), b([&] { push_one(2); }), c(pop_one), d(pop_one);
  }
  waitpoint::check(waitpoint::linearizable(history, Fifo()));
}

TEST(SharedQueue, IsAQueue) {
  const auto report = waitpoint::explore([] { use(&SharedQueue::pop); });
  EXPECT_TRUE(report.passed) << report;
}

TEST(MendedQueue, IsAQueue) {
  const auto report = waitpoint::explore([] { use(&SharedQueue::pop_at_once); });
  EXPECT_TRUE(report.passed) << report;
}

}  // namespace
