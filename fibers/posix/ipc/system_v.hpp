// SPDX-License-Identifier: BSD-3-Clause
// Common parts of System V's semaphores, shared memory and message queues: keys, identifiers and permissions.
//
// The objects are the simulation's own: all programs of one simulation and all processes of their family share them, no
// other process sees them, and they are gone when it ends. They are in the family's memory, are changed within its
// section only, and have Linux's default limits.
#pragma once

#include <sys/ipc.h>
#include <sys/types.h>

#include <cerrno>
#include <climits>
#include <cstddef>
#include <new>
#include <type_traits>

#include "core/error.hpp"
#include "core/time.hpp"
#include "fibers/kernel/task.hpp"
#include "fibers/posix/base/argument_memory.hpp"
#include "fibers/posix/base/chain.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/family/processes.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/waitable.hpp"

namespace waitpoint::posix::system_v {

inline constexpr unsigned identifiers_a_slot = 32768;
static_assert(identifiers_a_slot * identifiers_a_slot - 1 <= INT_MAX, "an identifier is an int and not negative");

/// The head of each of them.
struct Common {
  explicit Common(const char* kind_of) : kind(kind_of) {}

  const char* kind;
  ipc_perm permissions{};
  int id = -1;
  unsigned users = 0;    ///< calls in progress on it
  bool removed = false;  ///< by IPC_RMID: it has no identifier any longer
};

/// Its waitable in this process.
struct Known : Waitable {
  static constexpr Kind kind_of_all = Kind::system_v;
  explicit Known(const void* address) : Waitable(kind_of_all, static_cast<const Common*>(address)->kind, address) {}
};
inline kernel::Object& object_of(const Common& common) { return waitable_at<Known>(&common).object; }

/// Makes the caller the creator and the first owner.
void set_creator(Common& common, key_t key, int flags);
/// True if the process has all rights in `asked`, given as for one class: 4 to read, 2 to write.
bool is_allowed(const Common& common, int asked);
/// True if the process may change or remove it.
bool is_owner(const Common& common);
/// IPC_SET: the owner and the mode.
void set_owner(Common& common, const ipc_perm& to);
/// The current time by CLOCK_REALTIME, in seconds.
time_t date();

/// A waitpoint; nothing before main().
void pass_if_simulated(kernel::Operation operation, kernel::Object* object);

/// Returns an object to the family's memory.
template <class T>
void free_object(T& object) {
  if (Waitable* const known = find_waitable(&object, Known::kind_of_all); known != nullptr) forget(*known);
  object.~T();
  family::give(&object);
}

/// All objects of a kind. An identifier is a slot and the number of its earlier uses.
template <class T, int most>
class Table {
  static_assert(most > 0 && most <= static_cast<int>(identifiers_a_slot), "identifiers of two slots would be equal");

 public:
  int end() const { return end_; }  ///< behind the greatest slot that was used
  T* in_slot(int slot) const { return slot >= 0 && slot < end_ ? slots_[slot] : nullptr; }
  /// Null if there is none of this identifier.
  T* find(int id) const {
    T* const found = id >= 0 ? in_slot(id % static_cast<int>(identifiers_a_slot)) : nullptr;
    return found != nullptr && found->id == id ? found : nullptr;
  }
  int count() const { return count_; }
  /// 0 if none is in use.
  int greatest_slot() const {
    int slot = end_ - 1;
    while (slot > 0 && slots_[slot] == nullptr) --slot;
    return slot < 0 ? 0 : slot;
  }

  /// As semget() and the like: `check` tests an object that exists already, `make` makes a new one; both return 0 or an
  /// error number.
  template <class Check, class Make>
  int get(key_t key, int flags, Check check, Make make) {
    if (key != IPC_PRIVATE)
      for (int slot = 0; slot < end_; ++slot) {
        T* const found = slots_[slot];
        if (found == nullptr || found->permissions.__key != key) continue;
        if ((flags & IPC_CREAT) != 0 && (flags & IPC_EXCL) != 0) return fail(EEXIST);
        if (const int error = check(*found); error != 0) return fail(error);
        return is_allowed(*found, (flags >> 6 | flags >> 3 | flags) & 7) ? found->id : fail(EACCES);
      }
    if (key != IPC_PRIVATE && (flags & IPC_CREAT) == 0) return fail(ENOENT);
    WAITPOINT_CHECK(end_ >= 0 && end_ <= most, "a table of System V's objects reaches beyond its slots");
    int slot = 0;
    while (slot < end_ && slots_[slot] != nullptr) ++slot;
    if (slot == most) return fail(ENOSPC);
    T* made = nullptr;
    if (const int error = make(made); error != 0) return fail(error);
    set_creator(*made, key, flags);
    made->id = static_cast<int>(used_[slot] % identifiers_a_slot * identifiers_a_slot) + slot;
    made->permissions.__seq = static_cast<unsigned short>(used_[slot]++);
    ++count_;  // before: a process that is killed in between leaves too great a count, never too small a one
    slots_[slot] = made;
    if (slot == end_) ++end_;
    return made->id;
  }

  /// Frees all objects; identifiers start again.
  void clear() {
    for (int slot = 0; slot < end_; ++slot) {
      if (slots_[slot] != nullptr) free_object(*slots_[slot]);
      slots_[slot] = nullptr;
      used_[slot] = 0;
    }
    end_ = count_ = 0;
  }

  /// Takes an object's identifier away; the object is freed when no call is in progress on it.
  void remove(T& object) {
    WAITPOINT_CHECK(!object.removed, "a System V object is removed twice");
    WAITPOINT_CHECK(count_ > 0, "a table of System V's objects has more objects than it counts");
    slots_[object.id % static_cast<int>(identifiers_a_slot)] = nullptr;
    object.removed = true;
    --count_;
  }

 private:
  T* slots_[most];
  unsigned short used_[most];
  int end_, count_;
};

/// A call in progress on an object, which is not freed before the call ends.
template <class T>
class Use {
 public:
  /// On the object that `find` returns.
  template <class Find>
  explicit Use(Find find) {
    object_ = find();
    if (object_ != nullptr) ++object_->users;
  }
  ~Use() {
    if (object_ == nullptr) return;
    WAITPOINT_CHECK(object_->users > 0, "a call ends on an object that counts no calls");
    if (--object_->users == 0 && object_->removed) free_object(*object_);
  }
  Use(const Use&) = delete;
  Use& operator=(const Use&) = delete;

  explicit operator bool() const { return object_ != nullptr; }
  T& operator*() const { return *object_; }
  T* operator->() const { return object_; }

 private:
  T* object_;
};

/// The record of a waiting call, in `list` and in the family's memory: however the call ends, by an exit of its thread
/// in a handler too, the record leaves both.
template <class Record>
class Listed {
 public:
  Listed(Record*& list, Record& record) : list_(list), record_(record) {}
  ~Listed() {
    posix::remove(list_, record_);
    family::give(&record_);
  }
  Listed(const Listed&) = delete;
  Listed& operator=(const Listed&) = delete;

 private:
  Record*& list_;
  Record& record_;
};

/// A new object of at least this size; null without memory.
template <class T>
T* make_object(std::size_t size = sizeof(T)) {
  static_assert(alignof(T) <= alignof(std::max_align_t), "the family's memory is aligned for no more");
  WAITPOINT_CHECK(size >= sizeof(T), "an object is made in less memory than it needs");
  void* const memory = family::take(size);
  return memory == nullptr ? nullptr : new (memory) T();
}

/// True if a command of shmctl() and the like can access `status`: to write it if it `tells` something, to read it for
/// IPC_SET.
inline bool has_memory(int command, bool tells, void* status) {
  return command == IPC_SET ? can_be_read(status) : !tells || can_be_written(status);
}

/// Removes the entries of killed processes from a list and passes each to `drop`. True if there was any. Within the
/// section.
template <class T, class ProcessOf, class Drop>
bool take_out_dead(T*& first, ProcessOf process_of, Drop drop) {
  bool any = false;
  for (T** link = &first; *link != nullptr;) {
    T* const each = *link;
    const pid_t process = process_of(*each);
    if (process == family::this_process() || family::lives(process)) {
      link = &each->next;
      continue;
    }
    *link = each->next;
    drop(*each);
    any = true;
  }
  return any;
}

/// The table of a kind.
template <class T>
T& table_of(family::Part part) {
  static_assert(std::is_trivially_default_constructible_v<T> && std::is_trivially_destructible_v<T>,
                "a table is memory full of zeroes");
  void* const memory = family::common(part, sizeof(T));
  if (memory == nullptr) refuse("there is no memory for System V's objects");
  return *static_cast<T*>(memory);
}

}  // namespace waitpoint::posix::system_v
