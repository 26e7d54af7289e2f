// SPDX-License-Identifier: BSD-3-Clause
//
// syscall(): what the C library's functions of the same names do, where they are simulated; the rest goes to the
// kernel.
#include <aio.h>
#include <fcntl.h>
#include <mqueue.h>
#include <poll.h>
#include <sched.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/msg.h>
#include <sys/random.h>
#include <sys/resource.h>
#include <sys/select.h>
#include <sys/sem.h>
#include <sys/sendfile.h>
#include <sys/shm.h>
#include <sys/signalfd.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <sys/timerfd.h>
#include <sys/times.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <type_traits>
#include <utility>

#include "fibers/posix/argument_memory.hpp"
#include "fibers/posix/clocks.hpp"
#include "fibers/posix/error_number.hpp"
#include "fibers/posix/futex.hpp"
#include "fibers/posix/interposed.hpp"
#include "fibers/posix/program.hpp"
#include "fibers/posix/signals.hpp"

namespace waitpoint::posix {
namespace {

template <class T>
T as(long word) {
  if constexpr (std::is_pointer_v<T>)
    return reinterpret_cast<T>(word);
  else
    return static_cast<T>(word);
}

/// The words of a call.
struct Words {
  long at[6];

  template <class Result, class... Arguments>
  long call(Result (*function)(Arguments...)) const {
    return call_with(function, std::index_sequence_for<Arguments...>());
  }
  template <class T>
  T word(int number) const {
    return as<T>(at[number]);
  }

 private:
  template <class Result, class... Arguments, std::size_t... Numbers>
  long call_with(Result (*function)(Arguments...), std::index_sequence<Numbers...>) const {
    if constexpr (std::is_pointer_v<Result>)
      return reinterpret_cast<long>(function(as<Arguments>(at[Numbers])...));
    else
      return static_cast<long>(function(as<Arguments>(at[Numbers])...));
  }
};

/// The call itself is no cancellation point, whatever it does.
class CancellationDisabled {
 public:
  CancellationDisabled() : thread_(is_simulated() ? &this_thread() : nullptr) {
    if (thread_ == nullptr) return;
    before_ = thread_->cancel_disabled;
    thread_->cancel_disabled = true;
  }
  ~CancellationDisabled() {
    if (thread_ != nullptr) thread_->cancel_disabled = before_;
  }
  CancellationDisabled(const CancellationDisabled&) = delete;
  CancellationDisabled& operator=(const CancellationDisabled&) = delete;

 private:
  Thread* thread_;
  bool before_ = false;
};

/// A set of signals as the system has it, or none.
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

/// What is done with a signal, as the system has it.
struct SystemAction {
  void (*handler)(int);
  unsigned long flags;
  void (*restorer)();
  SignalSet mask;
};

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

long queue_signal(pid_t process, const siginfo_t& information) {
  return sigqueue(process, information.si_signo, information.si_value);
}

long make_timer(clockid_t clock, sigevent* event, int* number) {
  timer_t made = nullptr;
  if (timer_create(clock, event, &made) != 0) return -1;
  *number = static_cast<int>(reinterpret_cast<std::uintptr_t>(made));
  return 0;
}

// What has sets of signals, with their size behind them.
long call_about_signals(long number, const Words& words) {
  constexpr long size_of_set = sizeof(SignalSet);
  const auto set = words.word<const SignalSet*>(0);
  switch (number) {
    case SYS_rt_sigaction:
      if (words.at[3] != size_of_set) return fail(EINVAL);
      return change_action(words.word<int>(0), words.word<const SystemAction*>(1), words.word<SystemAction*>(2));
    case SYS_rt_sigprocmask:
      if (words.at[3] != size_of_set) return fail(EINVAL);
      return change_mask(words.word<int>(0), words.word<const SignalSet*>(1), words.word<SignalSet*>(2));
    case SYS_rt_sigpending: return tell_pending(words.word<SignalSet*>(0));
    case SYS_rt_sigsuspend: return sigsuspend(Mask(set).get());
    case SYS_rt_sigtimedwait:
      return sigtimedwait(Mask(set).get(), words.word<siginfo_t*>(1), words.word<const timespec*>(2));
    case SYS_rt_sigqueueinfo: {
      siginfo_t information = *words.word<const siginfo_t*>(2);
      information.si_signo = words.word<int>(1);
      return queue_signal(words.word<pid_t>(0), information);
    }
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
      const auto mask = words.word<const WithSize*>(5);
      return pselect(words.word<int>(0), words.word<fd_set*>(1), words.word<fd_set*>(2), words.word<fd_set*>(3),
                     words.word<const timespec*>(4), Mask(mask != nullptr ? mask->set : nullptr).get());
    }
    default:  // SYS_epoll_pwait
      return epoll_pwait(words.word<int>(0), words.word<epoll_event*>(1), words.word<int>(2), words.word<int>(3),
                         Mask(words.word<const SignalSet*>(4)).get());
  }
}

long simulated_call(long number, const Words& words) {
  const auto timer = reinterpret_cast<timer_t>(static_cast<std::uintptr_t>(words.at[0]));
  switch (number) {
    case SYS_futex: return words.call(futex);
    case SYS_gettid: return gettid();
    case SYS_kill: return words.call(kill);
    case SYS_tgkill: return words.call(tgkill);
    case SYS_tkill: return words.at[0] <= 0 ? fail(EINVAL) : tgkill(getpid(), words.word<pid_t>(0), words.word<int>(1));
    case SYS_rt_sigaction:
    case SYS_rt_sigprocmask:
    case SYS_rt_sigpending:
    case SYS_rt_sigsuspend:
    case SYS_rt_sigtimedwait:
    case SYS_rt_sigqueueinfo:
    case SYS_signalfd:
    case SYS_signalfd4:
    case SYS_ppoll:
    case SYS_pselect6:
    case SYS_epoll_pwait: return call_about_signals(number, words);
    case SYS_sigaltstack: return words.call(sigaltstack);
    case SYS_pause: return pause();

    case SYS_sched_yield: return sched_yield();
    case SYS_getrandom: return words.call(getrandom);
    case SYS_getrusage: return getrusage(static_cast<__rusage_who_t>(words.at[0]), words.word<rusage*>(1));

    case SYS_nanosleep: return words.call(nanosleep);
    case SYS_clock_nanosleep: {
      const long error = words.call(clock_nanosleep);
      return error == 0 ? 0 : fail(static_cast<int>(error));
    }
    case SYS_clock_getres: return words.call(clock_getres);
    case SYS_clock_settime: return words.call(clock_settime);
    case SYS_clock_gettime: {
      if (!can_be_written(words.word<void*>(1))) return fail(EFAULT);
      return read_clock(words.word<clockid_t>(0), *words.word<timespec*>(1));
    }
    case SYS_gettimeofday: return words.call(gettimeofday);
    case SYS_time: return words.call(time);
    case SYS_times: return words.call(times);
    case SYS_alarm: return words.call(alarm);
    case SYS_setitimer:
      return setitimer(static_cast<__itimer_which_t>(words.at[0]), words.word<const itimerval*>(1),
                       words.word<itimerval*>(2));
    case SYS_getitimer: return getitimer(static_cast<__itimer_which_t>(words.at[0]), words.word<itimerval*>(1));
    case SYS_timer_create: return make_timer(words.word<clockid_t>(0), words.word<sigevent*>(1), words.word<int*>(2));
    case SYS_timer_settime:
      return timer_settime(timer, words.word<int>(1), words.word<const itimerspec*>(2), words.word<itimerspec*>(3));
    case SYS_timer_gettime: return timer_gettime(timer, words.word<itimerspec*>(1));
    case SYS_timer_getoverrun: return timer_getoverrun(timer);
    case SYS_timer_delete: return timer_delete(timer);
    case SYS_timerfd_create: return words.call(timerfd_create);
    case SYS_timerfd_settime: return words.call(timerfd_settime);
    case SYS_timerfd_gettime: return words.call(timerfd_gettime);

    case SYS_semget: return words.call(semget);
    case SYS_semop: return words.call(semop);
    case SYS_semtimedop: return words.call(semtimedop);
    case SYS_semctl: return semctl(words.word<int>(0), words.word<int>(1), words.word<int>(2), words.at[3]);
    case SYS_msgget: return words.call(msgget);
    case SYS_msgsnd: return words.call(msgsnd);
    case SYS_msgrcv: return words.call(msgrcv);
    case SYS_msgctl: return words.call(msgctl);
    case SYS_shmget: return words.call(shmget);
    case SYS_shmat: return words.call(shmat);
    case SYS_shmdt: return words.call(shmdt);
    case SYS_shmctl: return words.call(shmctl);
    case SYS_mq_timedsend:
      return words.at[4] != 0 ? words.call(mq_timedsend)
                              : mq_send(words.word<mqd_t>(0), words.word<const char*>(1), words.word<std::size_t>(2),
                                        words.word<unsigned>(3));
    case SYS_mq_timedreceive:
      return words.at[4] != 0 ? words.call(mq_timedreceive)
                              : mq_receive(words.word<mqd_t>(0), words.word<char*>(1), words.word<std::size_t>(2),
                                           words.word<unsigned*>(3));

    case SYS_fork:
    case SYS_vfork: return fork();
    case SYS_wait4: return words.call(wait4);
    case SYS_waitid:
      return waitid(static_cast<idtype_t>(words.at[0]), words.word<id_t>(1), words.word<siginfo_t*>(2),
                    words.word<int>(3));
    case SYS_execve: return words.call(execve);

    case SYS_open: return open(words.word<const char*>(0), words.word<int>(1), words.word<mode_t>(2));
    case SYS_openat:
      return openat(words.word<int>(0), words.word<const char*>(1), words.word<int>(2), words.word<mode_t>(3));
    case SYS_fcntl: return fcntl(words.word<int>(0), words.word<int>(1), words.at[2]);
    case SYS_flock: return words.call(flock);
    case SYS_close: return words.call(close);
    case SYS_dup: return words.call(dup);
    case SYS_dup2: return words.call(dup2);
    case SYS_dup3: return words.call(dup3);
    case SYS_pipe: return words.call(static_cast<int (*)(int*)>(pipe));
    case SYS_pipe2: return words.call(pipe2);
    case SYS_eventfd: return eventfd(words.word<unsigned>(0), 0);
    case SYS_eventfd2: return words.call(eventfd);
    case SYS_epoll_create: return words.call(epoll_create);
    case SYS_epoll_create1: return words.call(epoll_create1);
    case SYS_epoll_ctl: return words.call(epoll_ctl);
    case SYS_epoll_wait: return words.call(epoll_wait);
    case SYS_poll: return words.call(poll);
    case SYS_select: return words.call(select);
    case SYS_read: return words.call(read);
    case SYS_write: return words.call(write);
    case SYS_readv: return words.call(readv);
    case SYS_writev: return words.call(writev);
    case SYS_splice: return words.call(splice);
    case SYS_tee: return words.call(tee);
    case SYS_vmsplice: return words.call(vmsplice);
    case SYS_sendfile: return words.call(sendfile);
    case SYS_socket: return words.call(socket);
    case SYS_socketpair: return words.call(socketpair);
    case SYS_connect: return connect(words.word<int>(0), words.word<const sockaddr*>(1), words.word<socklen_t>(2));
    case SYS_accept: return accept(words.word<int>(0), words.word<sockaddr*>(1), words.word<socklen_t*>(2));
    case SYS_accept4:
      return accept4(words.word<int>(0), words.word<sockaddr*>(1), words.word<socklen_t*>(2), words.word<int>(3));
    case SYS_sendto:
      return sendto(words.word<int>(0), words.word<const void*>(1), words.word<std::size_t>(2), words.word<int>(3),
                    words.word<const sockaddr*>(4), words.word<socklen_t>(5));
    case SYS_recvfrom:
      return recvfrom(words.word<int>(0), words.word<void*>(1), words.word<std::size_t>(2), words.word<int>(3),
                      words.word<sockaddr*>(4), words.word<socklen_t*>(5));
    case SYS_sendmsg: return words.call(sendmsg);
    case SYS_recvmsg: return words.call(recvmsg);
    case SYS_shutdown: return words.call(shutdown);
    default:
      return WAITPOINT_NEXT(syscall)(number, words.at[0], words.at[1], words.at[2], words.at[3], words.at[4],
                                     words.at[5]);
  }
}

}  // namespace
}  // namespace waitpoint::posix

using namespace waitpoint::posix;

WAITPOINT_INTERPOSED long syscall(long number, ...) noexcept {
  va_list more;
  va_start(more, number);
  Words words;
  for (long& word : words.at) word = va_arg(more, long);
  va_end(more);
  if (is_host_code())
    return WAITPOINT_NEXT(syscall)(number, words.at[0], words.at[1], words.at[2], words.at[3], words.at[4],
                                   words.at[5]);
  // To the system, a child that shares nothing is a fork.
  if (number == SYS_clone && words.at[0] == SIGCHLD && words.at[1] == 0) return fork();
  const CancellationDisabled disabled;
  return simulated_call(number, words);
}

WAITPOINT_INTERPOSED pid_t gettid() noexcept {
  return is_simulated() ? this_thread().id : static_cast<pid_t>(WAITPOINT_NEXT(syscall)(SYS_gettid));
}
