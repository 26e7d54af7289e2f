// SPDX-License-Identifier: BSD-3-Clause
// The values that one thread has of what is local to threads, simulated or real: made at first use, destroyed in the
// reverse order. A thread has few of them: they are sought one after the other.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace waitpoint::sync {

class LocalValues {
 public:
  LocalValues() = default;
  ~LocalValues() { clear(); }
  LocalValues(const LocalValues&) = delete;
  LocalValues& operator=(const LocalValues&) = delete;

  /// The value of that key; where there is none, made by `initial`, or by default where that is empty.
  template <class T>
  T& get(std::uint64_t key, const std::function<T()>& initial) {
    for (const Value& value : values_)
      if (value.key == key) return *static_cast<T*>(value.address);
    std::unique_ptr<T> made;
    if constexpr (std::is_default_constructible_v<T>) {
      made.reset(initial ? new T(initial()) : new T());
    } else {
      made.reset(new T(initial()));
    }
    values_.push_back({key, made.get(), [](void* address) { delete static_cast<T*>(address); }});
    return *made.release();
  }

  /// The latest first; also what destructors use for the first time.
  void clear() {
    while (!values_.empty()) {
      const Value last = values_.back();
      values_.pop_back();
      last.destroy(last.address);
    }
  }

 private:
  struct Value {
    std::uint64_t key;
    void* address;
    void (*destroy)(void*);
  };
  std::vector<Value> values_;
};

/// What tells one thread-local from all others that ever were in this process; never part of an event.
inline std::uint64_t next_local_key() {
  static std::atomic<std::uint64_t> last = 0;
  return ++last;
}

/// A variable of which each thread has its own; `values` says whose turn it is.
template <class T, LocalValues& (*values)()>
class Local {
 public:
  Local() requires std::is_default_constructible_v<T>
  = default;
  /// `initial` makes the value of each thread.
  explicit Local(std::function<T()> initial) : initial_(std::move(initial)) {}
  Local(const Local&) = delete;
  Local& operator=(const Local&) = delete;

  /// The running thread's own value.
  T& operator*() const { return get(); }
  T* operator->() const { return &get(); }
  T& get() const { return values().template get<T>(key_, initial_); }

 private:
  std::uint64_t key_ = next_local_key();
  std::function<T()> initial_;
};

}  // namespace waitpoint::sync
