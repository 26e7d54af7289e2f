// SPDX-License-Identifier: BSD-3-Clause
// The thread-local values of one thread, simulated or real: made at first use, destroyed in reverse order. They are
// few, so the search is linear.
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

  /// The value for `key`; a new one is made by `initial`, or default-constructed if `initial` is empty.
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

  /// In reverse order of construction, including values that destructors create meanwhile.
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

/// A key unique to each thread-local variable of the process; never part of an event.
inline std::uint64_t next_local_key() {
  static std::atomic<std::uint64_t> last = 0;
  return ++last;
}

/// A thread-local variable; `values` returns the running thread's values.
template <class T, LocalValues& (*values)()>
class Local {
 public:
  Local() requires std::is_default_constructible_v<T>
  = default;
  /// `initial` makes each thread's value.
  explicit Local(std::function<T()> initial) : initial_(std::move(initial)) {}
  Local(const Local&) = delete;
  Local& operator=(const Local&) = delete;

  /// The running thread's value.
  T& operator*() const { return get(); }
  T* operator->() const { return &get(); }
  T& get() const { return values().template get<T>(key_, initial_); }

 private:
  std::uint64_t key_ = next_local_key();
  std::function<T()> initial_;
};

}  // namespace waitpoint::sync
