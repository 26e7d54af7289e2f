// SPDX-License-Identifier: BSD-3-Clause
// Containers for several tasks: correct ones, and ones with a planted bug each.
#pragma once

#include <array>
#include <map>
#include <mutex>
#include <optional>
#include <vector>

#include "fibers/sync/atomic.hpp"
#include "fibers/sync/mutex.hpp"

namespace waitpoint::containers {

/// Correct.
class Queue {
 public:
  void push(int value) {
    const std::lock_guard lock(mutex_);
    values_.push_back(value);
  }
  std::optional<int> pop() {
    const std::lock_guard lock(mutex_);
    if (values_.empty()) return std::nullopt;
    const int first = values_.front();
    values_.erase(values_.begin());
    return first;
  }

 protected:
  mutex mutex_;
  std::vector<int> values_;
};

/// Looks at the first element and removes it under two locks: it may give one twice.
class DoublingQueue : public Queue {
 public:
  std::optional<int> pop() {
    std::unique_lock lock(mutex_);
    if (values_.empty()) return std::nullopt;
    const int first = values_.front();
    lock.unlock();
    lock.lock();
    if (!values_.empty()) values_.erase(values_.begin());
    return first;
  }
};

/// One queue for each of two producers: the older element may be in the other one.
class LanedQueue {
 public:
  void push(int value) { lanes_[static_cast<std::size_t>(value) % 2].push(value); }
  std::optional<int> pop() {
    const std::optional<int> found = lanes_[0].pop();
    return found ? found : lanes_[1].pop();
  }

 private:
  std::array<Queue, 2> lanes_;
};

/// A stack of at most four elements, by two atomics that change one after the other: an element may be lost.
class LosingStack {
 public:
  void push(int value) {
    const std::size_t top = size_.load();
    values_[top].store(value);
    size_.store(top + 1);
  }
  std::optional<int> pop() {
    const std::size_t top = size_.load();
    if (top == 0) return std::nullopt;
    size_.store(top - 1);
    return values_[top - 1].load();
  }

 private:
  atomic<std::size_t> size_{0};
  std::array<atomic<int>, 4> values_{};
};

/// With a copy for readers that is written later: a read after a write may see the old value.
class LateRegister {
 public:
  void write(int value) {
    value_.store(value);
    copy_.store(value_.load());
  }
  int read() { return value_.load(); }
  int read_copy() { return copy_.load(); }

 private:
  atomic<int> value_{0}, copy_{0};
};

/// Replaces a value by removing it and putting the new one: meanwhile there is none.
class GappyMap {
 public:
  void put(int key, int value) {
    take(key);
    const std::lock_guard lock(mutex_);
    values_[key] = value;
  }
  std::optional<int> get(int key) {
    const std::lock_guard lock(mutex_);
    const auto found = values_.find(key);
    return found == values_.end() ? std::nullopt : std::optional(found->second);
  }
  void take(int key) {
    const std::lock_guard lock(mutex_);
    values_.erase(key);
  }

 private:
  mutex mutex_;
  std::map<int, int> values_;
};

}  // namespace waitpoint::containers
