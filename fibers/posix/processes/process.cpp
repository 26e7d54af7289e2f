// SPDX-License-Identifier: BSD-3-Clause
//
// fork(): the child is another process of the family, with the calling thread.
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "core/error.hpp"
#include "fibers/kernel/common_order.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/kernel/run_window.hpp"
#include "fibers/kernel/tasks.hpp"
#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/descriptors/descriptors.hpp"
#include "fibers/posix/descriptors/epoll_watches.hpp"
#include "fibers/posix/descriptors/pace.hpp"
#include "fibers/posix/family/turn.hpp"
#include "fibers/posix/input_output/asynchronous.hpp"
#include "fibers/posix/ipc/named_objects.hpp"
#include "fibers/posix/ipc/system_v_ends.hpp"
#include "fibers/posix/links/datagram_medium.hpp"
#include "fibers/posix/processes/children.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/signals/cancellation.hpp"
#include "fibers/posix/signals/signals.hpp"
#include "fibers/posix/sync/futex_vectors.hpp"
#include "fibers/posix/sync/robust_mutexes.hpp"
#include "fibers/posix/threads/thread.hpp"
#include "fibers/posix/timers/program_timers.hpp"
#include "fibers/posix/traps/raw_calls.hpp"

namespace waitpoint::posix {
namespace {

// `waitpoint exec` does not watch the child, which gets a copy of the record at the same address. The copy is made
// before the fork, as the parent continues at once.
static_assert(record_address % 4096 == 0 && record_bytes % 4096 == 0 && sizeof(Record) <= record_bytes);
void* copy_of_record = nullptr;
family::Process* expected = nullptr;

bool is_copied = false;

void drop_copy() {
  if (copy_of_record != nullptr) munmap(copy_of_record, record_bytes);
  copy_of_record = nullptr;
  is_copied = false;
}

// Makes room for the copy. Returns an error number.
int expect_child() {
  if (copy_of_record != nullptr) return 0;
  void* const room =
      mmap(nullptr, record_bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (room == MAP_FAILED) return ENOMEM;
  copy_of_record = room;
  expected = family::expect_child();
  if (expected != nullptr) return 0;
  drop_copy();
  return EAGAIN;
}

void copy_record() {
  if (!is_simulated() || is_copied) return;
  share_named_semaphores();
  if (expect_child() != 0) refuse("there is no memory for a child's simulation");
  const auto used = static_cast<const char*>(record->arena.top()) - reinterpret_cast<const char*>(record);
  WAITPOINT_CHECK(
      used >= static_cast<std::ptrdiff_t>(sizeof(Record)) && used <= static_cast<std::ptrdiff_t>(record_bytes),
      "the record's arena reaches out of the record");
  std::memcpy(copy_of_record, static_cast<void*>(record), static_cast<std::size_t>(used));
  is_copied = true;
  family::let_begin(*expected);  // the program's handlers before the fork may have waited until now
}

void take_own_record() {
  const int flags = MREMAP_MAYMOVE | MREMAP_FIXED;
  if (mremap(copy_of_record, record_bytes, record_bytes, flags, record) == MAP_FAILED)
    refuse("there is no memory for a child's simulation");
  copy_of_record = nullptr;
  is_copied = false;
}

// The events of the child are its own.
void begin_events() {
  kernel::Scheduler& scheduler = *kernel::running->scheduler;
  kernel::Robot& robot = record->robot;
  const auto number = static_cast<std::uint64_t>(family::own->id);
  kernel::copy_name(robot.name, family::own->name);
  robot.id = Digest::mix(robot.id + number);
  robot.digest = PairDigest();
  robot.outputs = 0;
  robot.digest_in_use = &family::own->digest;
  kernel::continue_as(scheduler, Digest::mix(kernel::running->id + number));
  family::limit_window(scheduler);
  kernel::pause(scheduler);
}

void end_other_tasks() {
  kernel::Scheduler& scheduler = *kernel::running->scheduler;
  for (kernel::Task *task = kernel::first_task(scheduler), *next = nullptr; task != nullptr; task = next) {
    next = task->next;
    if (task == kernel::running) continue;
    leave_mutexes_of(*task);
    kernel::end_in_place(*task);
  }
  WAITPOINT_CHECK(first_task() == kernel::running && kernel::running->next == nullptr,
                  "a child has tasks of its parent's");
}

// In the child, before any handler of pthread_atfork() of the program's. The child has begun once it has the copy.
void begin_as_child() {
  if (!is_simulated() || copy_of_record == nullptr) return;
  take_own_record();
  family::begin_as_child(*expected);
  expected = nullptr;
  system_v::inherit_memory(family::own->parent);
  forget_waiters();
  note_shared_epolls();
  forget_datagrams();
  forget_native_children();
  forget_vectors();
  leave_shared_mutexes();
  end_other_tasks();
  forget_timers_of(this_program());
  forget_asynchronous_requests();
  forget_pending_signals();
  begin_again_as_first(this_thread());
  trap_raw_calls_of_child();
  begin_events();
}

}  // namespace

void before_child() { pass(kernel::Operation::start, nullptr); }

pid_t fork_by(pid_t (*real)(const void*), const void* argument, bool calls_handlers) {
  before_child();
  if (const int error = expect_child(); error != 0) return fail(error);
  if (!calls_handlers) copy_record();
  const pid_t child = real(argument);
  if (child == 0) begin_as_child();
  WAITPOINT_CHECK(child != 0 || copy_of_record == nullptr, "a child has not begun its own simulation");
  if (child == 0) return 0;
  drop_copy();
  family::Process& made = *std::exchange(expected, nullptr);
  family::note_child(made, child);
  return child > 0 ? made.id : child;
}

// No other handler runs between these and the fork: the one registered first is called last before a fork.
void register_fork() { pthread_atfork(copy_record, drop_copy, begin_as_child); }

namespace {

// Until the child of a vfork() executes a program, also natively, or ends.
void await_return(const family::Process& child) {
  static constinit kernel::Object object{"child"};
  struct Borrower {
    const family::Process* process;
    pid_t id;
  } const borrower{&child, child.id};
  const auto has_returned = [](const void* what) {
    const auto& [process, id] = *static_cast<const Borrower*>(what);
    return process->id != id || !process->borrows || process->is_native ||
           process->state == family::Process::State::ended;
  };
  while (!has_returned(&borrower)) {
    kernel::enter(object);
    wait_on_shared(object, Time::max(), has_returned, &borrower);
    if (deliverable(this_thread()) != 0) handle_signals();
  }
}

}  // namespace

void await_child_in_system() {
  process_program.signals.ever_blocked |= only(SIGCHLD);
  install(SIGCHLD);
}

bool is_in_process() { return has_host && is_simulated(); }

}  // namespace waitpoint::posix

using namespace waitpoint;
using namespace waitpoint::posix;

WAITPOINT_INTERPOSED pid_t fork() noexcept {
  if (is_in_process()) return fail(ENOSYS);
  if (!is_simulated()) return WAITPOINT_NEXT(fork)();
  return fork_by([](const void*) { return WAITPOINT_NEXT(fork)(); }, nullptr, true);
}
WAITPOINT_INTERPOSED pid_t _Fork() noexcept {
  if (is_in_process()) return fail(ENOSYS);
  if (!is_simulated()) return WAITPOINT_NEXT(_Fork)();
  return fork_by([](const void*) { return WAITPOINT_NEXT(_Fork)(); }, nullptr, false);
}

// The child does not share its parent's memory, but the parent waits for its end or exec, as programs may expect.
WAITPOINT_INTERPOSED pid_t vfork() noexcept {
  if (!is_simulated()) return WAITPOINT_NEXT(fork)();
  if (is_in_process()) return fail(ENOSYS);
  const pid_t id = fork();
  if (id <= 0) return id;
  family::Process& child = *family::find(id);
  child.borrows = true;
  await_return(child);
  return id;
}
