// SPDX-License-Identifier: BSD-3-Clause
// What primitives have in common that are shared between processes: all that they are is in their own bytes, changed
// within a family's section. A count of the changes is there too: who cannot go on waits for it to move.
#pragma once

#include <cstdint>

#include "fibers/posix/descriptors/descriptors.hpp"
#include "fibers/posix/family/family.hpp"
#include "fibers/posix/program/waitable.hpp"
#include "fibers/posix/program/waiting.hpp"

namespace waitpoint::posix {

/// In the bytes of an object that is shared, where zeroes or another value say that it is not.
inline constexpr std::uint32_t mark_of_shared = 0x53484152;

/// What the bytes of a primitive begin with that processes may share. They are zeroes before it is used.
template <class Known>
struct SharedBytes {
  Known* known;  ///< of one that is not shared
  std::uint32_t mark;

  bool is_shared() const { return mark == mark_of_shared; }
  /// What stands for it in this process.
  Known& waitable() { return is_shared() ? waitable_at<Known>(this) : waitable_at(known, this); }
};

/// Waits for another change than those that were counted when the caller, within the section, found that it must wait:
/// of `object`, which stands for it in this process.
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

/// After the section in which a change was made and counted: whoever waits looks again.
inline void tell_change(kernel::Object& object) {
  if (is_simulated()) kernel::running->scheduler->wake_all(object);
  family::ring();
}

}  // namespace waitpoint::posix
