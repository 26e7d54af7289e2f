// SPDX-License-Identifier: BSD-3-Clause
// What System V's semaphores, shared memory and message queues have in common: keys, identifiers and permissions.
//
// The objects are the simulation's own: all programs of one simulation and all processes of their family share them, no
// other process sees them, and they are gone when it ends. They lie in the family's memory, are changed within its
// section alone, and keep to the limits that Linux begins with.
#pragma once

#include <sys/ipc.h>
#include <sys/types.h>

#include <cerrno>
#include <new>

#include "core/time.hpp"
#include "fibers/kernel/task.hpp"
#include "fibers/posix/base/argument_memory.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/family/family.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/waitable.hpp"

namespace waitpoint::posix::system_v {

inline constexpr unsigned identifiers_a_slot = 32768;

/// What each of them begins with.
struct Common {
  explicit Common(const char* kind_of) : kind(kind_of) {}

  const char* kind;
  ipc_perm permissions{};
  int id = -1;
  unsigned users = 0;    ///< calls that are within it
  bool removed = false;  ///< by IPC_RMID: it has no identifier any more
};

/// What stands for it in this process.
struct Known : Waitable {
  static constexpr Kind kind_of_all = Kind::system_v;
  explicit Known(const void* address) : Waitable(kind_of_all, static_cast<const Common*>(address)->kind, address) {}
};
inline kernel::Object& object_of(const Common& common) { return waitable_at<Known>(&common).object; }

/// Who makes an object is its creator and owner, for the first time.
void set_creator(Common& common, key_t key, int flags);
/// Whether the process has all the rights of `asked`, as of one class: 4 to read, 2 to write.
bool is_allowed(const Common& common, int asked);
/// Whether the process may change or remove it.
bool is_owner(const Common& common);
/// Of IPC_SET: the owner and the mode.
void set_owner(Common& common, const ipc_perm& to);
/// Seconds of CLOCK_REALTIME, now.
time_t date();

/// What counts for an event; nothing before main().
void pass_if_simulated(kernel::Operation operation, kernel::Object* object);

/// Back to the family's memory, within its section.
template <class T>
void free_object(T& object) {
  if (Waitable* const known = find_waitable(&object, Known::kind_of_all); known != nullptr) forget(*known);
  object.~T();
  family::give(&object);
}

/// All objects of a kind, within the family's section: an identifier is a slot and how often the slot was used before.
template <class T, int most>
class Table {
 public:
  int end() const { return end_; }  ///< behind the greatest slot that was used
  T* in_slot(int slot) const { return slot >= 0 && slot < end_ ? slots_[slot] : nullptr; }
  /// Null if there is none of this identifier.
  T* find(int id) const {
    T* const found = id >= 0 ? in_slot(id % static_cast<int>(identifiers_a_slot)) : nullptr;
    return found != nullptr && found->id == id ? found : nullptr;
  }
  int count() const { return count_; }
  /// 0 where none is in use.
  int greatest_slot() const {
    int slot = end_ - 1;
    while (slot > 0 && slots_[slot] == nullptr) --slot;
    return slot < 0 ? 0 : slot;
  }

  /// As semget() and its kin: `check` says what is wrong with an object that exists already, and `make` makes one that
  /// does not; both give 0 or an error.
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
    int slot = 0;
    while (slot < end_ && slots_[slot] != nullptr) ++slot;
    if (slot == most) return fail(ENOSPC);
    T* made = nullptr;
    if (const int error = make(made); error != 0) return fail(error);
    set_creator(*made, key, flags);
    made->id = static_cast<int>(used_[slot] % identifiers_a_slot * identifiers_a_slot) + slot;
    made->permissions.__seq = static_cast<unsigned short>(used_[slot]++);
    slots_[slot] = made;
    if (slot == end_) ++end_;
    ++count_;
    return made->id;
  }

  /// None are there any more, and identifiers begin anew.
  void clear() {
    for (int slot = 0; slot < end_; ++slot) {
      if (slots_[slot] != nullptr) free_object(*slots_[slot]);
      slots_[slot] = nullptr;
      used_[slot] = 0;
    }
    end_ = count_ = 0;
  }

  /// Takes an object's identifier away; it is freed once no call is within it.
  void remove(T& object) {
    slots_[object.id % static_cast<int>(identifiers_a_slot)] = nullptr;
    object.removed = true;
    --count_;
  }

 private:
  T* slots_[most];
  unsigned short used_[most];
  int end_, count_;
};

/// A call that is within an object, which stays until the call is done. Outside the section.
template <class T>
class Use {
 public:
  /// Of what `find` finds, within the section.
  template <class Find>
  explicit Use(Find find) {
    const family::Section section;
    object_ = find();
    if (object_ != nullptr) ++object_->users;
  }
  ~Use() {
    if (object_ == nullptr) return;
    const family::Section section;
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

/// A new one, of this size at least, within the section; null if there is no memory.
template <class T>
T* make_object(std::size_t size = sizeof(T)) {
  void* const memory = family::take(size);
  return memory == nullptr ? nullptr : new (memory) T();
}

/// Whether a command of shmctl() and its kin, one that `tells` something or another, can write that, or read what it
/// sets.
inline bool has_memory(int command, bool tells, void* status) {
  return command == IPC_SET ? can_be_read(status) : !tells || can_be_written(status);
}

/// Takes out of a list what belongs to processes that were killed, and gives each to `drop`; whether there was any.
/// Within the section.
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

/// The table of a kind, within the section.
template <class T>
T& table_of(family::Part part) {
  void* const memory = family::common(part, sizeof(T));
  if (memory == nullptr) refuse("there is no memory for System V's objects");
  return *static_cast<T*>(memory);
}

}  // namespace waitpoint::posix::system_v
