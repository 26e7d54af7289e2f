// SPDX-License-Identifier: BSD-3-Clause
// A mutex that its owner may lock repeatedly, in the names and semantics of std::recursive_mutex and
// std::recursive_timed_mutex. The last matching unlock hands it over, as a mutex.
#pragma once

#include "fibers/sync/mutex_core.hpp"
#include "fibers/sync/timed.hpp"

namespace waitpoint {

class recursive_mutex {
 public:
  constexpr recursive_mutex() = default;
  /// `label` is shown in reports; it must outlive the mutex.
  explicit constexpr recursive_mutex(const char* label) : core_("recursive mutex", label) {}
  recursive_mutex(const recursive_mutex&) = delete;
  recursive_mutex& operator=(const recursive_mutex&) = delete;

  void lock() { lock_before(Time::max()); }
  bool try_lock() { return lock_before(sync::long_past); }
  void unlock();

 protected:
  bool lock_before(Time deadline);

 private:
  sync::MutexCore core_{"recursive mutex", ""};
  std::uint64_t depth_ = 0;  // the owner's lock count
};

using recursive_timed_mutex = sync::timed<recursive_mutex>;

}  // namespace waitpoint
