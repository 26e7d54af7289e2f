// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/descriptors/descriptors.hpp"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>

#include "core/error.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/base/real_waits.hpp"
#include "fibers/posix/family/order.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/signals/cancellation.hpp"
#include "fibers/posix/time/clocks.hpp"

namespace waitpoint::posix {
namespace {

constexpr int known_max = known_descriptors_max;
static_assert(known_max % 64 == 0, "the sets of descriptors are whole words");
std::uint64_t inside[known_max / 64];
ino_t inodes[known_max];                       // of the pipes and sockets inside; 0: not known yet
std::uint64_t waited_in_vain[known_max / 64];  // for a reader
const Program* owners[known_max];              // among several programs of a process
int owned_end = 0;                             // one past the greatest ever owned

/// A waiting thread; on its own stack.
struct Waiter {
  kernel::Task* task;
  pollfd* descriptors;
  nfds_t count;
  bool outside;
  bool (*is_ready)(const void*) = nullptr;  // null: one of the descriptors
  const void* what = nullptr;
  Waiter* next = nullptr;
  Waiter* previous = nullptr;
};
Waiter* first = nullptr;
Waiter* last = nullptr;
int waiting_outside = 0;
int waiting_for_no_descriptor = 0;  // these must be polled

kernel::Object descriptors_object{"descriptor"};
kernel::Object outside_object{"something outside"};

int poll_now(pollfd* descriptors, nfds_t count, int timeout_ms = 0) {
  const int error = errno;
  const int ready = WAITPOINT_NEXT(poll)(descriptors, count, timeout_ms);
  if (ready >= 0) errno = error;
  return ready;
}

// For the other processes of the family.
void note_waits() {
  if (family::own == nullptr) return;
  family::own->listens = first != nullptr;
  family::own->waits_outside = waiting_outside > 0;
}

void count_outside(const Waiter& waiter, int by) {
  waiting_outside += by;
  if (waiter.count == 0) waiting_for_no_descriptor += by;
  WAITPOINT_CHECK(waiting_for_no_descriptor >= 0 && waiting_outside >= waiting_for_no_descriptor,
                  "the counts of threads that wait outside disagree");
}

void add(Waiter& waiter) {
  WAITPOINT_CHECK(last == nullptr ? first == nullptr : last->next == nullptr && last != &waiter,
                  "the end of the list of waiting threads is broken");
  waiter.next = nullptr;
  waiter.previous = last;
  (last == nullptr ? first : last->next) = &waiter;
  last = &waiter;
  if (waiter.outside) count_outside(waiter, 1);
  note_waits();
}

void remove(Waiter& waiter) {
  WAITPOINT_CHECK((waiter.previous == nullptr ? first : waiter.previous->next) == &waiter &&
                      (waiter.next == nullptr ? last : waiter.next->previous) == &waiter,
                  "a thread that ends its wait is not in the list of waiting threads");
  (waiter.previous == nullptr ? first : waiter.previous->next) = waiter.next;
  (waiter.next == nullptr ? last : waiter.next->previous) = waiter.previous;
  if (waiter.outside) count_outside(waiter, -1);
  note_waits();
}

// Wakes the threads whose descriptors are ready.
bool wake_ready(bool outside_too) {
  bool any = false;
  for (Waiter* waiter = first; waiter != nullptr; waiter = waiter->next) {
    if (waiter->task->state != kernel::TaskState::blocked || (waiter->outside && !outside_too)) continue;
    const bool is_ready = waiter->is_ready != nullptr ? waiter->is_ready(waiter->what)
                                                      : poll_now(waiter->descriptors, waiter->count) != 0;
    if (!is_ready) continue;
    // is_ready() may have woken it.
    if (waiter->task->state == kernel::TaskState::blocked) waiter->task->scheduler->wake(*waiter->task);
    any = true;
  }
  return any;
}

// As ppoll(), or until a signal comes; a signal that comes before the wait begins is not missed.
void poll_until_a_signal(pollfd* descriptors, nfds_t count, const timespec* longest) {
  const ErrorNumberKept kept;
  const RealWait real;
  sigset_t all, before;
  sigfillset(&all);
  WAITPOINT_NEXT(pthread_sigmask)(SIG_SETMASK, &all, &before);
  if (!has_come_from_outside()) WAITPOINT_NEXT(ppoll)(descriptors, count, longest, &before);
  WAITPOINT_NEXT(pthread_sigmask)(SIG_SETMASK, &before, nullptr);
}

// Waits in real time for any descriptor that a thread waits for.
void wait_really(Duration longest) {
  nfds_t count = 0;
  for (const Waiter* waiter = first; waiter != nullptr; waiter = waiter->next) count += waiter->count;
  auto* const all = static_cast<pollfd*>(std::malloc((count + 1) * sizeof(pollfd)));
  if (all == nullptr) refuse("there is no memory to wait for descriptors");
  nfds_t at = 0;
  for (const Waiter* waiter = first; waiter != nullptr; waiter = waiter->next) {
    if (waiter->count == 0) continue;
    WAITPOINT_CHECK(waiter->count <= count - at, "the descriptors waited for exceed their number");
    std::memcpy(all + at, waiter->descriptors, waiter->count * sizeof(pollfd));
    at += waiter->count;
  }
  constexpr Duration asking = Duration(std::chrono::milliseconds(20));
  if (waiting_for_no_descriptor > 0 && asking < longest) longest = asking;
  const timespec timeout = to_timespec(longest.ns());
  poll_until_a_signal(all, count, longest == Duration::max() ? nullptr : &timeout);
  std::free(all);
}

}  // namespace

void (*before_look)() = nullptr;

bool anybody_waits_outside() { return waiting_outside > 0; }

void note_inside(int descriptor, bool is) {
  if (descriptor < 0 || descriptor >= known_max) return;
  const std::uint64_t bit = std::uint64_t{1} << (descriptor % 64);
  std::uint64_t& word = inside[descriptor / 64];
  word = is ? word | bit : word & ~bit;
  waited_in_vain[descriptor / 64] &= ~bit;
  owners[descriptor] = nullptr;
  inodes[descriptor] = 0;
  if (is) note_owner(descriptor);
}

void note_owner(int descriptor) {
  if (descriptor < 0 || descriptor >= known_max || !is_simulated() || !this_program().is_member) return;
  owners[descriptor] = &this_program();
  if (descriptor >= owned_end) owned_end = descriptor + 1;
}

int next_owned(int from, const Program*& owner) {
  WAITPOINT_CHECK(from >= 0 && owned_end <= known_max, "the table of owners is read outside its range");
  for (int descriptor = from; descriptor < owned_end; ++descriptor)
    if ((owner = owners[descriptor]) != nullptr) return descriptor;
  return -1;
}

void disown(int descriptor) {
  WAITPOINT_CHECK(descriptor >= 0 && descriptor < owned_end && owners[descriptor] != nullptr,
                  "a descriptor without an owner is disowned");
  owners[descriptor] = nullptr;
}

bool is_inside(int descriptor) {
  return descriptor >= 0 && descriptor < known_max && (inside[descriptor / 64] >> (descriptor % 64) & 1) != 0;
}

namespace {

/// The pipes and sockets inside, by their inodes: a table with open addressing.
struct InsideFile {
  ino_t inode;
  int held;  ///< bytes in the pipe at the last check, by any process
};
constexpr std::size_t inside_files_max = 1 << 16;

// The entry of this inode, or a free one for it; null if the table is full.
InsideFile* place_of(ino_t inode) {
  auto* const all =
      static_cast<InsideFile*>(family::common(family::Part::inside_files, sizeof(InsideFile) * inside_files_max));
  const std::size_t first = Digest::mix(inode) % inside_files_max;
  for (std::size_t i = 0; all != nullptr && i < inside_files_max; ++i) {
    InsideFile& each = all[(first + i) % inside_files_max];
    if (each.inode == inode || each.inode == 0) return &each;
  }
  return nullptr;
}

// 0 for other files.
ino_t inode_of(int descriptor) {
  struct stat status {};
  if (fstat(descriptor, &status) != 0) return 0;
  return S_ISFIFO(status.st_mode) || S_ISSOCK(status.st_mode) ? status.st_ino : 0;
}

template <class Visit>
void for_each_inside(Visit visit) {
  for (int word = 0; word < known_max / 64; ++word)
    for (std::uint64_t left = inside[word]; left != 0; left &= left - 1) visit(word * 64 + __builtin_ctzll(left));
}

}  // namespace

bool has_unnoticed_output() {
  bool any = false;
  for_each_inside([&any](int descriptor) {
    ino_t& inode = inodes[descriptor];
    if (inode == 0) inode = inode_of(descriptor);
    int bytes = 0;
    if (inode == 0 || WAITPOINT_NEXT(ioctl)(descriptor, FIONREAD, &bytes) != 0) return;
    InsideFile* const file = place_of(inode);
    if (file == nullptr || (file->inode == inode && file->held == bytes)) return;
    *file = {inode, bytes};
    any = true;
  });
  return any;
}

void note_start(bool is_native) {
  const ErrorNumberKept kept;
  for_each_inside([&](int descriptor) {
    if (is_native) {
      if ((WAITPOINT_NEXT(fcntl)(descriptor, F_GETFD) & FD_CLOEXEC) == 0) note_inside(descriptor, false);
      return;
    }
    const ino_t inode = inode_of(descriptor);
    InsideFile* const file = inode != 0 ? place_of(inode) : nullptr;
    if (file != nullptr && file->inode != inode) *file = {inode, 0};
  });
}

void inherit_inside() {
  const ErrorNumberKept kept;
  constexpr int most = 1024;
  for (int descriptor = 0; descriptor < most; ++descriptor) {
    const ino_t inode = inode_of(descriptor);
    const InsideFile* const file = inode != 0 ? place_of(inode) : nullptr;
    if (file != nullptr && file->inode == inode) note_inside(descriptor, true);
  }
}

void forget_waiters() {
  first = last = nullptr;
  waiting_outside = waiting_for_no_descriptor = 0;
}

void forget_waiter(const kernel::Task& task) {
  for (Waiter* waiter = first; waiter != nullptr; waiter = waiter->next)
    if (waiter->task == &task) return remove(*waiter);
}

int wait_for(pollfd* descriptors, nfds_t count, Time deadline, Restart restart) {
  kernel::Task& task = *kernel::running;
  bool outside = false;
  // A host does not look outside at the end of its instants: descriptors are checked when a guest acts on one.
  for (nfds_t i = 0; i < count && !has_host; ++i)
    if (descriptors[i].fd >= 0 && !is_inside(descriptors[i].fd)) outside = true;
  if (!outside)
    if (const int ready = poll_now(descriptors, count); ready != 0) return ready;
  for (;;) {
    if (deadline <= task.local_time) return poll_now(descriptors, count);
    task.scheduler->enter(descriptors_object);
    Waiter waiter{&task, descriptors, count, outside};
    add(waiter);
    // While a thread waits outside, the run pauses at the end of each instant.
    if (outside) task.scheduler->pause();
    const Wait ended = wait_on(descriptors_object, deadline);
    remove(waiter);
    // Another thread may have taken the data.
    if (const int ready = poll_now(descriptors, count); ready != 0) return ready;
    if (thread_of(task).in_cancellation_point && is_to_leave(thread_of(task))) return 0;
    if (ended == Wait::interrupted && is_interrupted(restart)) return fail(EINTR);
  }
}

int wait_for(int descriptor, short events, Time deadline, Restart restart) {
  pollfd one{descriptor, events, 0};
  return wait_for(&one, 1, deadline, restart);
}

WaitsOutside::WaitsOutside() {
  ++waiting_outside;
  note_waits();
  kernel::running->scheduler->pause();
}
WaitsOutside::~WaitsOutside() {
  WAITPOINT_CHECK(waiting_outside > waiting_for_no_descriptor, "more waits for signals have ended than begun");
  --waiting_outside;
  note_waits();
}

int wait_outside(bool (*is_ready)(const void*), const void* what, Restart restart) {
  kernel::Task& task = *kernel::running;
  while (!is_ready(what)) {
    task.scheduler->enter(outside_object);
    Waiter waiter{&task, nullptr, 0, true, is_ready, what};
    add(waiter);
    task.scheduler->pause();
    const Wait ended = wait_on(outside_object, Time::max());
    remove(waiter);
    if (thread_of(task).in_cancellation_point && is_to_leave(thread_of(task))) return 0;
    if (ended == Wait::interrupted && !is_ready(what) && is_interrupted(restart)) return fail(EINTR);
  }
  return 1;
}

Wait wait_on_shared(kernel::Object& object, Time deadline, bool (*is_ready)(const void*), const void* what) {
  // Without other processes the thread that changes the object wakes the others; only the last change by a process that
  // has ended may not have been seen.
  if (is_ready(what)) return Wait::came;
  Waiter waiter{kernel::running, nullptr, 0, false, is_ready, what};
  add(waiter);
  const Wait ended = wait_on(object, deadline);
  remove(waiter);
  return ended;
}

bool wait_for_reader(int descriptor, int patience_ms) {
  WAITPOINT_CHECK(descriptor >= 0, "a reader is waited for at no descriptor");
  pollfd one{descriptor, POLLOUT, 0};
  if (poll_now(&one, 1) > 0) return true;
  // A thread whose descriptors are ready may be the reader.
  for (const Waiter* waiter = first; waiter != nullptr; waiter = waiter->next)
    if (waiter->count > 0 && poll_now(waiter->descriptors, waiter->count) > 0) return false;
  // An outside reader that did not read last time is not waited for again.
  const bool is_known = descriptor < known_max;
  std::uint64_t none = 0;
  std::uint64_t& word = is_known ? waited_in_vain[descriptor / 64] : none;
  const std::uint64_t bit = std::uint64_t{1} << (descriptor % 64);
  if ((word & bit) != 0) return false;
  if (poll_now(&one, 1, patience_ms) > 0) return true;
  word |= bit;
  return false;
}

void look_at_descriptors() {
  if (before_look != nullptr) before_look();
  if (first != nullptr) wake_ready(false);
  family::ring();
}

bool wait_outside_for(Duration longest) {
  wait_really(longest);
  return has_come_from_outside() || waiting_outside > 0;
}

bool look_outside(bool may_wait) {
  const bool came = take_in_signals_from_outside();
  if (wake_ready(true) || came) return true;
  if (!may_wait) return false;
  if (waiting_outside == 0) return false;
  wait_really(Duration::max());
  take_in_signals_from_outside();
  wake_ready(true);
  return true;
}

}  // namespace waitpoint::posix
