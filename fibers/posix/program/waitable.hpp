// SPDX-License-Identifier: BSD-3-Clause
// The kernel's state of a primitive of the program.
//
// The primitive's own bytes are too few for it: they hold a pointer, null where they are zero, as static initialisers
// leave them. Objects of four bytes (futexes, spin locks, once flags) have no room for a pointer, and are found by
// address. Programs abandon mutexes without destroying them (std::mutex does), so the next object at the same address
// reuses the state.
#pragma once

#include <cstddef>
#include <cstdint>
#include <new>

#include "fibers/kernel/task.hpp"
#include "fibers/posix/base/bounded_text.hpp"

namespace waitpoint::posix {

struct Waitable {
  enum class Kind : std::uint8_t { mutex, condition, rwlock, semaphore, barrier, word, system_v };

  Waitable(Kind kind_of, const char* name, const void* at) : object(name), kind(kind_of), address(at) {}
  bool idle() const { return object.owner == nullptr && object.first_waiter == nullptr; }

  kernel::Object object;
  Kind kind;
  bool is_freed = false;  ///< the memory of the program's object
  const void* address;
  Waitable* next_of_bucket = nullptr;
};

/// In the bytes of a primitive that was destroyed, and is not shared by processes: it has no waitable any more.
inline constexpr std::uint32_t mark_of_destroyed = 0x44455354;

/// Enough for any kind.
inline constexpr std::size_t waitable_bytes_max = 256;

/// At the beginning of a run: reserves address space for all, with memory on first use.
void reserve_waitables();
struct ReservedAddresses {
  std::uintptr_t begin, end;
};
/// Empty if they could not be reserved.
ReservedAddresses reserved_for_waitables();
/// The waitable of this kind kept for `address`; null if there is none.
Waitable* find_waitable(const void* address, Waitable::Kind kind);
/// A cell for a new waitable, entered in the table under `address`.
void* fresh_cell(const void* address);
/// Frees the cell of a destroyed primitive.
void forget(Waitable& waitable);
/// The memory is about to be freed: marks the waitables in it, and returns one that threads wait for; null without one.
Waitable* mark_freed(const void* memory, std::size_t bytes);
/// "mutex jobs_lock", or the address if the program has no symbol for it.
void add_waitable(BoundedText& text, const Waitable& waitable);
/// The waitable of an object, for reports; null if the object belongs to no primitive.
const Waitable* waitable_of(const kernel::Object& object);

/// True if the run is reported in words, with the names of the program's variables.
extern bool names_waitables;
void label(Waitable& waitable);

template <class T>
T& make_waitable(const void* address) {
  static_assert(sizeof(T) <= waitable_bytes_max && waitable_bytes_max % alignof(T) == 0, "T fits into a cell");
  void* const cell = fresh_cell(address);
  Waitable* const next = static_cast<Waitable*>(cell)->next_of_bucket;
  T* const made = new (cell) T(address);
  made->next_of_bucket = next;
  if (names_waitables) label(*made);
  return *made;
}

/// The waitable that `slot`, a word of the primitive at `address`, points to; made at the first use, and for the copy
/// of a primitive, as of one in an array that has grown: POSIX leaves it undefined, programs do it.
template <class T>
T& waitable_at(T*& slot, const void* address) {
  if (__builtin_expect(slot == nullptr || slot->address != address, 0)) slot = &make_waitable<T>(address);
  return *slot;
}

/// The same for a primitive without room for a pointer.
template <class T>
T& waitable_at(const void* address) {
  if (Waitable* found = find_waitable(address, T::kind_of_all); found != nullptr) return *static_cast<T*>(found);
  return make_waitable<T>(address);
}

}  // namespace waitpoint::posix
