// SPDX-License-Identifier: BSD-3-Clause
#include <poll.h>
#include <sys/epoll.h>
#include <sys/select.h>
#include <sys/signalfd.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstddef>

#include "fibers/posix/base/argument_memory.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/base/system_call_words.hpp"
#include "fibers/posix/signals/signals.hpp"

namespace waitpoint::posix {
namespace {

/// The system's set of signals, or none.
class Mask {
 public:
  explicit Mask(const SignalSet* from) : is_there_(from != nullptr) {
    if (is_there_) set_ = to_sigset(*from);
  }
  const sigset_t* get() const { return is_there_ ? &set_ : nullptr; }

 private:
  bool is_there_;
  sigset_t set_;
};

/// The system's layout of an action.
struct SystemAction {
  void (*handler)(int);
  unsigned long flags;
  void (*restorer)();
  SignalSet mask;
};
static_assert(sizeof(SystemAction) == 32 && offsetof(SystemAction, flags) == 8 &&
              offsetof(SystemAction, restorer) == 16 && offsetof(SystemAction, mask) == 24);
static_assert(sizeof(SignalSet) * 8 == signals_end - 1, "the system's set has a bit for each signal");

bool is_none_or_readable(long address) { return address == 0 || can_be_read(as<const void*>(address)); }
bool is_none_or_writable(long address) { return address == 0 || can_be_written(as<void*>(address)); }

// Checks the memory that is accessed here; the functions check their own arguments. Returns an error number.
int error_of(long number, const CallWords& words) {
  constexpr long size_of_set = sizeof(SignalSet);
  const auto set_of_size = [&](int set, int size) {
    return words.at[size] != size_of_set ? EINVAL : can_be_read(words.word<void*>(set)) ? 0 : EFAULT;
  };
  const auto mask_of_size = [&](int mask, int size) { return words.at[mask] == 0 ? 0 : set_of_size(mask, size); };
  switch (number) {
    case SYS_rt_sigaction:
    case SYS_rt_sigprocmask:
      if (words.at[3] != size_of_set) return EINVAL;
      return is_none_or_readable(words.at[1]) && is_none_or_writable(words.at[2]) ? 0 : EFAULT;
    case SYS_rt_sigpending:
      if (words.at[1] > size_of_set) return EINVAL;
      return can_be_written(words.word<void*>(0)) ? 0 : EFAULT;
    case SYS_rt_sigsuspend: return set_of_size(0, 1);
    case SYS_rt_sigtimedwait: return set_of_size(0, 3);
    case SYS_signalfd:
    case SYS_signalfd4: return set_of_size(1, 2);
    case SYS_ppoll: return mask_of_size(3, 4);
    case SYS_pselect6: return is_none_or_readable(words.at[5]) ? 0 : EFAULT;
    case SYS_epoll_pwait: return mask_of_size(4, 5);
    default: return 0;
  }
}

long change_action(int signal, const SystemAction* to, SystemAction* old) {
  struct sigaction action {
  }, before{};
  if (to != nullptr) {
    action.sa_handler = to->handler;
    action.sa_flags = static_cast<int>(to->flags);
    action.sa_mask = to_sigset(to->mask);
  }
  if (sigaction(signal, to != nullptr ? &action : nullptr, &before) != 0) return -1;
  if (old != nullptr)
    *old = {before.sa_handler, static_cast<unsigned long>(before.sa_flags), before.sa_restorer, to_set(before.sa_mask)};
  return 0;
}

long change_mask(int how, const SignalSet* to, SignalSet* old) {
  sigset_t before;
  if (sigprocmask(how, Mask(to).get(), &before) != 0) return -1;
  if (old != nullptr) *old = to_set(before);
  return 0;
}

long tell_pending(SignalSet* set) {
  sigset_t pending;
  if (sigpending(&pending) != 0) return -1;
  *set = to_set(pending);
  return 0;
}

// The program's siginfo_t is delivered as it is. The system handles signals to other processes.
long queue_signal(long number, const CallWords& words) {
  const bool to_thread = number == SYS_rt_tgsigqueueinfo;
  const auto told = words.word<const siginfo_t*>(to_thread ? 3 : 2);
  if (!is_simulated() || words.word<pid_t>(0) != getpid())
    return WAITPOINT_NEXT(syscall)(number, words.at[0], words.at[1], words.at[2], words.at[3]);
  if (!can_be_read(told)) return fail(EFAULT);
  siginfo_t information = *told;
  information.si_signo = words.word<int>(to_thread ? 2 : 1);
  const int error = to_thread ? send_as_told(information, words.word<int>(1)) : send_as_told(information);
  return error == 0 ? 0 : fail(error);
}

}  // namespace

long call_about_signals(long number, const CallWords& words) {
  const auto set = words.word<const SignalSet*>(0);
  if (const int error = is_simulated() ? error_of(number, words) : 0; error != 0) return fail(error);
  switch (number) {
    case SYS_rt_sigaction:
      return change_action(words.word<int>(0), words.word<const SystemAction*>(1), words.word<SystemAction*>(2));
    case SYS_rt_sigprocmask:
      return change_mask(words.word<int>(0), words.word<const SignalSet*>(1), words.word<SignalSet*>(2));
    case SYS_rt_sigpending: return tell_pending(words.word<SignalSet*>(0));
    case SYS_rt_sigsuspend: return sigsuspend(Mask(set).get());
    case SYS_rt_sigtimedwait:
      return sigtimedwait(Mask(set).get(), words.word<siginfo_t*>(1), words.word<const timespec*>(2));
    case SYS_rt_sigqueueinfo:
    case SYS_rt_tgsigqueueinfo: return queue_signal(number, words);
    case SYS_signalfd:
    case SYS_signalfd4:
      return signalfd(words.word<int>(0), Mask(words.word<const SignalSet*>(1)).get(),
                      number == SYS_signalfd4 ? words.word<int>(3) : 0);
    case SYS_ppoll:
      return ppoll(words.word<pollfd*>(0), words.word<nfds_t>(1), words.word<const timespec*>(2),
                   Mask(words.word<const SignalSet*>(3)).get());
    case SYS_pselect6: {
      struct WithSize {
        const SignalSet* set;
        std::size_t size;
      };
      static_assert(sizeof(WithSize) == 16 && offsetof(WithSize, size) == 8);
      const auto mask = words.word<const WithSize*>(5);
      return pselect(words.word<int>(0), words.word<fd_set*>(1), words.word<fd_set*>(2), words.word<fd_set*>(3),
                     words.word<const timespec*>(4), Mask(mask != nullptr ? mask->set : nullptr).get());
    }
    default:  // SYS_epoll_pwait
      return epoll_pwait(words.word<int>(0), words.word<epoll_event*>(1), words.word<int>(2), words.word<int>(3),
                         Mask(words.word<const SignalSet*>(4)).get());
  }
}

}  // namespace waitpoint::posix
