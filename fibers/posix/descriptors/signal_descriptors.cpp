// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/descriptors/signal_descriptors.hpp"

#include <fcntl.h>
#include <sys/eventfd.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <new>

#include "core/error.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/posix/base/argument_memory.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/descriptors/descriptors.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/state_calls.hpp"
#include "fibers/posix/signals/signals.hpp"

namespace waitpoint::posix {
namespace {

struct SignalDescriptor {
  int descriptor;
  const Program* program;
  SignalSet set;
  bool can_be_read;
  SignalDescriptor* next;
};
SignalDescriptor* first_descriptor = nullptr;

SignalDescriptor* find_descriptor(int descriptor) {
  SignalDescriptor* each = first_descriptor;
  while (each != nullptr && each->descriptor != descriptor) each = each->next;
  return each;
}

// For any thread of the program: a reader takes the signals pending for itself.
SignalSet pending_anywhere_in(const Program& program) {
  SignalSet set = program.signals.pending.set();
  for (const kernel::Task* task = kernel::first_task(*program.robot->scheduler); task != nullptr; task = task->next)
    if (is_thread(*task) && thread_of(*task).program == &program) set |= thread_of(*task).pending.set();
  return set;
}

static_assert(sizeof(signalfd_siginfo) == 128, "programs read records of the kernel's size");

signalfd_siginfo to_record(const siginfo_t& from) {
  WAITPOINT_CHECK(is_signal(from.si_signo), "a signal without a number is read");
  signalfd_siginfo to{};
  to.ssi_signo = static_cast<std::uint32_t>(from.si_signo);
  to.ssi_errno = from.si_errno;
  to.ssi_code = from.si_code;
  if (from.si_code == SI_TIMER) {
    to.ssi_tid = static_cast<std::uint32_t>(from.si_timerid);
    to.ssi_overrun = static_cast<std::uint32_t>(from.si_overrun);
  } else {
    to.ssi_pid = static_cast<std::uint32_t>(from.si_pid);
    to.ssi_uid = from.si_uid;
  }
  if (from.si_signo == SIGCHLD) to.ssi_status = from.si_status;
  to.ssi_ptr = reinterpret_cast<std::uintptr_t>(from.si_ptr);
  to.ssi_int = from.si_int;
  return to;
}

}  // namespace

bool is_signal_descriptor(int descriptor) {
  return first_descriptor != nullptr && find_descriptor(descriptor) != nullptr;
}

void show_signal_descriptors() {
  if (first_descriptor == nullptr) return;
  const ErrorNumberKept kept;
  bool any = false;
  for (SignalDescriptor* each = first_descriptor; each != nullptr; each = each->next) {
    const bool can_be_read = (each->set & pending_anywhere_in(*each->program)) != 0;
    if (can_be_read == each->can_be_read) continue;
    each->can_be_read = can_be_read;
    eventfd_t word = 1;
    [[maybe_unused]] const ssize_t done = can_be_read ? WAITPOINT_NEXT(write)(each->descriptor, &word, sizeof word)
                                                      : WAITPOINT_NEXT(read)(each->descriptor, &word, sizeof word);
    any = any || can_be_read;
  }
  if (any) look_at_descriptors();
}

void forget_signal_descriptor(int descriptor) {
  for (SignalDescriptor** link = &first_descriptor; *link != nullptr; link = &(*link)->next) {
    SignalDescriptor* const each = *link;
    if (each->descriptor != descriptor) continue;
    *link = each->next;
    std::free(each);
    return;
  }
}

ssize_t read_signals(int descriptor, void* bytes, std::size_t size) {
  const SignalDescriptor* const known = find_descriptor(descriptor);
  if (known == nullptr) return fail(EBADF);  // another thread has closed it meanwhile
  WAITPOINT_CHECK((known->set & unblockable) == 0, "a descriptor reads signals that nothing can block");
  if (size < sizeof(signalfd_siginfo)) return fail(EINVAL);
  auto* to = static_cast<signalfd_siginfo*>(bytes);
  std::size_t count = 0;
  siginfo_t information{};
  while ((count + 1) * sizeof *to <= size && take_pending(known->set, information) != 0)
    to[count++] = to_record(information);
  return count == 0 ? fail(EAGAIN) : static_cast<ssize_t>(count * sizeof *to);
}

}  // namespace waitpoint::posix

using namespace waitpoint::posix;

WAITPOINT_INTERPOSED int signalfd(int descriptor, const sigset_t* set, int flags) noexcept {
  before_call<"signalfd">(changing(place::descriptors | place::channels));
  if (!is_simulated()) return WAITPOINT_NEXT(signalfd)(descriptor, set, flags);
  if (!can_be_read(set)) return fail(EFAULT);
  if ((flags & ~(SFD_NONBLOCK | SFD_CLOEXEC)) != 0) return fail(EINVAL);
  const SignalSet signals = to_set(*set) & ~unblockable;
  SignalDescriptor* known = find_descriptor(descriptor);
  if (descriptor >= 0 && known == nullptr) return fail(WAITPOINT_NEXT(fcntl)(descriptor, F_GETFD) < 0 ? EBADF : EINVAL);
  if (known == nullptr) {
    known = static_cast<SignalDescriptor*>(std::calloc(1, sizeof(SignalDescriptor)));
    if (known == nullptr) return fail(ENOMEM);
    static_assert(int{SFD_NONBLOCK} == int{EFD_NONBLOCK} && int{SFD_CLOEXEC} == int{EFD_CLOEXEC});
    known->descriptor = eventfd(0, flags);
    if (known->descriptor < 0) {
      std::free(known);
      return -1;
    }
    // Its signals may come from outside.
    note_inside(known->descriptor, false);
    known->program = &this_program();
    known->next = first_descriptor;
    first_descriptor = known;
    after_pending_changed = show_signal_descriptors;
  }
  known->set = signals;
  show_signal_descriptors();
  return known->descriptor;
}
