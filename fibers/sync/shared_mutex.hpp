// SPDX-License-Identifier: BSD-3-Clause
// A reader-writer lock, in the names and semantics of std::shared_mutex and std::shared_timed_mutex.
//
// Readers and writers alternate, so that neither starves (phase-fair: Brandenburg, Anderson: Spin-based reader-writer
// synchronization for multiprocessor real-time systems, 2010). In the default order:
//
//   a reader acquires at once if no writer holds the lock or waits for it; else it waits
//   when the last reader leaves, the first waiting writer acquires
//   when a writer leaves, all waiting readers acquire together; if there are none, the first writer
//
// In other orders the chooser picks the next holder at an unlock: one of the writers, or all readers together.
//
// Relocking is reported as a self-deadlock: lock() by a reader or by the writer, lock_shared() by the writer. Other
// undefined behaviour of the standard is a misuse here: the same by try_lock(), a second lock_shared() by a reader,
// unlocking without holding it, ending a thread that holds it, destroying it while it is held or waited for.
#pragma once

#include <vector>

#include "fibers/sync/object.hpp"
#include "fibers/sync/report/misuse.hpp"
#include "fibers/sync/timed.hpp"

namespace waitpoint {

class shared_mutex {
 public:
  shared_mutex() = default;
  /// `label` is shown in reports; it must outlive the mutex.
  explicit shared_mutex(const char* label) : object_("shared mutex", label) {}
  shared_mutex(const shared_mutex&) = delete;
  shared_mutex& operator=(const shared_mutex&) = delete;

  void lock();
  bool try_lock() { return lock_before(sync::long_past); }
  void unlock();

  void lock_shared();
  bool try_lock_shared() { return lock_shared_before(sync::long_past); }
  void unlock_shared();

 protected:
  bool lock_before(Time deadline);
  bool lock_shared_before(Time deadline);

 private:
  void refresh();
  bool is_reader(const kernel::Task& task) const;
  bool acquire(Time deadline);
  bool acquire_shared(Time deadline);
  void add_reader(kernel::Task& task);
  void remove_reader(kernel::Task& task);
  void admit_readers();
  void hand_over(bool readers_first);

  std::vector<kernel::Task*> readers_;  // the shared holders
  sync::Object object_{"shared mutex"};
};

class shared_timed_mutex : public sync::timed<shared_mutex> {
 public:
  using sync::timed<shared_mutex>::timed;

  template <class Rep, class Ratio>
  bool try_lock_shared_for(const std::chrono::duration<Rep, Ratio>& span) {
    return lock_shared_before(sync::after(span));
  }
  template <class Clock, class Span>
  bool try_lock_shared_until(const std::chrono::time_point<Clock, Span>& deadline) {
    return lock_shared_before(sync::until(deadline));
  }
};

}  // namespace waitpoint
