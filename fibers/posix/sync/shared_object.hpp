// SPDX-License-Identifier: BSD-3-Clause
// Common parts of process-shared primitives: their whole state is in the program's object, which only the process with
// the turn changes. It includes a count of changes, on which threads wait.
#pragma once

#include <cstdint>

#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/posix/descriptors/descriptors.hpp"
#include "fibers/posix/family/misuse.hpp"
#include "fibers/posix/family/order.hpp"
#include "fibers/posix/program/waitable.hpp"
#include "fibers/posix/program/waiting.hpp"

namespace waitpoint::posix {

/// Marks the program's object as process-shared; any other value: private.
inline constexpr std::uint32_t mark_of_shared = 0x53484152;
static_assert(mark_of_shared != 0, "static initialisers leave zeroes, which are private");

/// The head of a primitive that processes may share, in the program's object. Zero before its first use.
template <class Known>
struct SharedBytes {
  Known* known;  ///< of a private one
  std::uint32_t mark;

  /// A copy has no waitable yet.
  void leave_original() {
    if (!is_shared() && known != nullptr && known->address != this) known = nullptr;
  }
  bool is_shared() const { return mark == mark_of_shared; }
  /// Reports its use if it was destroyed, or its memory freed.
  void check(const char* does) {
    if (is_shared()) return;
    leave_original();
    if (mark == mark_of_destroyed && known == nullptr)
      note_misuse(does, Known(this), ", which was destroyed");
    else if (known != nullptr)
      check_is_there(does, *known);
  }
  /// Forgets its waitable.
  void destroy(Waitable::Kind kind) {
    leave_original();
    Waitable* const waitable = is_shared() ? find_waitable(this, kind) : known;
    if (waitable != nullptr && !is_shared() && waitable->object.first_waiter != nullptr)
      note_misuse("destroys", *waitable, ", awaited by ", waitable->object.first_waiter);
    if (waitable != nullptr) forget(*waitable);
    known = nullptr;
    if (!is_shared()) mark = mark_of_destroyed;
  }
  /// Its waitable in this process.
  Known& waitable() { return is_shared() ? waitable_at<Known>(this) : waitable_at(known, this); }
};

/// Waits until the count of changes differs from `seen`, its value when the caller found that it
/// must wait. `object` is the primitive's in this process.
inline Wait wait_for_change(kernel::Object& object, const std::uint32_t& changes, std::uint32_t seen, Time deadline) {
  struct Seen {
    const std::uint32_t* changes;
    std::uint32_t seen;
  } const last{&changes, seen};
  const auto has_changed = [](const void* what) {
    const auto& known = *static_cast<const Seen*>(what);
    return __atomic_load_n(known.changes, __ATOMIC_SEQ_CST) != known.seen;
  };
  return wait_on_shared(object, deadline, has_changed, &last);
}

/// After a change was made and counted: all waiters check again.
inline void tell_change(kernel::Object& object) {
  if (is_simulated()) kernel::wake_all(*kernel::running->scheduler, object);
  family::ring(family::of_objects);
}

}  // namespace waitpoint::posix
