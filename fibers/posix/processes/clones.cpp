// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/processes/clones.hpp"

#include <linux/sched.h>
#include <sched.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>
#include <cstdlib>
#include <utility>

#include "core/error.hpp"
#include "fibers/kernel/turn.hpp"
#include "fibers/posix/base/argument_memory.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/base/system_call_words.hpp"
#include "fibers/posix/descriptors/descriptors.hpp"
#include "fibers/posix/descriptors/pace.hpp"
#include "fibers/posix/family/turn.hpp"
#include "fibers/posix/processes/children.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/sync/robust_mutexes.hpp"
#include "fibers/posix/threads/thread.hpp"

namespace waitpoint::posix {
namespace {

/// The arguments of clone().
struct Clone {
  int (*function)(void*);
  void* stack;
  std::uint64_t flags;
  void* argument;
  pid_t* parent_id;
  void* thread_storage;
  pid_t* child_id;
};

bool is_last_of_program() {
  for (const kernel::Task* task = first_task(); task != nullptr; task = task->next)
    if (task != kernel::running && is_thread(*task) && thread_of(*task).program == &this_program()) return false;
  return true;
}

// SYS_exit: no code of the program is called for the thread's end.
[[noreturn]] void exit_thread(int status) {
  if (is_last_of_program()) _exit(status);
  let_robust_mutexes_go();
  end_running_thread();
}

void* run_clone(void* memory) {
  const Clone clone = *static_cast<Clone*>(memory);
  std::free(memory);
  if ((clone.flags & CLONE_CHILD_SETTID) != 0) *clone.child_id = this_thread().id;
  if ((clone.flags & CLONE_CHILD_CLEARTID) != 0)
    this_thread().cleared_at_end = reinterpret_cast<std::uint32_t*>(clone.child_id);
  exit_thread(clone.function(clone.argument));
}

int make_thread(const Clone& clone) {
  auto* const memory = static_cast<Clone*>(std::malloc(sizeof(Clone)));
  if (memory == nullptr) return fail(ENOMEM);
  *memory = clone;
  pthread_attr_t detached;
  pthread_attr_init(&detached);
  pthread_attr_setdetachstate(&detached, PTHREAD_CREATE_DETACHED);
  pthread_t made{};
  const int error = create(&made, &detached, {.posix = run_clone}, false, memory);
  pthread_attr_destroy(&detached);
  if (error != 0) {
    std::free(memory);
    return fail(error);
  }
  WAITPOINT_CHECK(find(made) != nullptr, "a thread was made that is not to be found");
  const int id = find(made)->id;
  if ((clone.flags & CLONE_PARENT_SETTID) != 0) *clone.parent_id = id;
  return id;
}

// In the child no thread is running: its calls go to the C library.
int lend_memory(const Clone& clone) {
  before_child();
  family::Process* const made = family::expect_child();
  if (made == nullptr) return fail(EAGAIN);
  family::let_begin(*made);
  family::set_native(*made, true);
  await_child_in_system();
  kernel::turn.close();
  kernel::Task* const task = std::exchange(kernel::running, nullptr);
  const int child = WAITPOINT_NEXT(clone)(clone.function, clone.stack, static_cast<int>(clone.flags | CLONE_VFORK),
                                          clone.argument, clone.parent_id, clone.thread_storage, clone.child_id);
  WAITPOINT_CHECK(kernel::running == nullptr, "a process that borrowed the memory has left a running task");
  kernel::running = task;
  const ErrorNumberKept kept;
  if (child > 0) note_native_child(child);
  const pid_t id = made->id;
  family::note_child(*made, child);
  if (child > 0 && (clone.flags & CLONE_PARENT_SETTID) != 0) *clone.parent_id = id;
  look_at_descriptors(family::of_anything);
  return child > 0 ? id : child;
}

// The system has written its own number of the child.
void correct_ids(long number, const CallWords& words, pid_t child) {
  std::uint64_t flags = 0;
  int *of_parent = nullptr, *of_child = nullptr;
  if (number == SYS_clone3) {
    const clone_args& arguments = *words.word<const clone_args*>(0);
    flags = arguments.flags;
    of_parent = reinterpret_cast<int*>(arguments.parent_tid);
    of_child = reinterpret_cast<int*>(arguments.child_tid);
  } else if (number == SYS_clone) {
    flags = static_cast<std::uint64_t>(words.at[0]);
    of_parent = words.word<int*>(2);
    of_child = words.word<int*>(3);
  }
  if (child > 0 && (flags & CLONE_PARENT_SETTID) != 0) *of_parent = child;
  if (child == 0 && (flags & CLONE_PARENT_SETTID) != 0) *of_parent = family::own->id;
  if (child == 0 && (flags & CLONE_CHILD_SETTID) != 0) *of_child = family::own->id;
}

long fork_by_number(long number, const CallWords& words) {
  struct Call {
    long number;
    const CallWords& words;
  };
  const auto real = [](const void* what) {
    const auto& [of, with] = *static_cast<const Call*>(what);
    return static_cast<pid_t>(
        WAITPOINT_NEXT(syscall)(of, with.at[0], with.at[1], with.at[2], with.at[3], with.at[4], with.at[5]));
  };
  const Call call{number, words};
  const pid_t child = fork_by(real, &call, false);
  correct_ids(number, words, child);
  return child;
}

int fork_and_call(const Clone& clone) {
  const CallWords words{{static_cast<long>(clone.flags), 0, reinterpret_cast<long>(clone.parent_id),
                         reinterpret_cast<long>(clone.child_id), 0, 0}};
  const auto child = static_cast<int>(fork_by_number(SYS_clone, words));
  if (child == 0) _exit(clone.function(clone.argument));
  return child;
}

int make_clone(const Clone& clone) {
  const bool shares_memory = (clone.flags & CLONE_VM) != 0, shares_actions = (clone.flags & CLONE_SIGHAND) != 0;
  if (clone.function == nullptr || clone.stack == nullptr) return fail(EINVAL);
  if ((shares_actions && !shares_memory) || ((clone.flags & CLONE_THREAD) != 0 && !shares_actions)) return fail(EINVAL);
  if ((clone.flags & CLONE_THREAD) != 0) return make_thread(clone);
  if (is_in_process()) return fail(ENOSYS);
  return shares_memory ? lend_memory(clone) : fork_and_call(clone);
}

}  // namespace

long call_about_clones(long number, const CallWords& words) {
  switch (number) {
    case SYS_exit: exit_thread(words.word<int>(0));
    case SYS_set_tid_address: this_thread().cleared_at_end = words.word<std::uint32_t*>(0); return this_thread().id;
    case SYS_clone:
      if (is_in_process() || (words.at[0] & CLONE_VM) != 0 || words.at[1] != 0) return fail(ENOSYS);
      return fork_by_number(number, words);
    default: {  // SYS_clone3
      const auto arguments = words.word<const clone_args*>(0);
      if (!can_be_read(arguments)) return fail(EFAULT);
      if (is_in_process() || (arguments->flags & CLONE_VM) != 0 || arguments->stack != 0) return fail(ENOSYS);
      return fork_by_number(number, words);
    }
  }
}

}  // namespace waitpoint::posix

using namespace waitpoint;
using namespace waitpoint::posix;

WAITPOINT_INTERPOSED int clone(int (*function)(void*), void* stack, int flags, void* argument, ...) noexcept {
  va_list more;
  va_start(more, argument);
  auto* const parent_id = va_arg(more, pid_t*);
  void* const thread_storage = va_arg(more, void*);
  auto* const child_id = va_arg(more, pid_t*);
  va_end(more);
  if (!is_simulated())
    return WAITPOINT_NEXT(clone)(function, stack, flags, argument, parent_id, thread_storage, child_id);
  const auto bits = static_cast<std::uint64_t>(static_cast<unsigned>(flags));
  return make_clone({function, stack, bits, argument, parent_id, thread_storage, child_id});
}
