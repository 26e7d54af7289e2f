// SPDX-License-Identifier: BSD-3-Clause
//
// syscall(): simulated calls do the same as the functions of their names; the others go to the system.
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
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <sys/timerfd.h>
#include <sys/times.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdarg>
#include <iterator>
#include <optional>

extern "C" {
#include <sys/pidfd.h>  // has no extern "C"
}

#include "core/error.hpp"
#include "fibers/posix/base/argument_memory.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/base/system_call_words.hpp"
#include "fibers/posix/processes/clones.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/repeatability.hpp"
#include "fibers/posix/program/state_calls.hpp"
#include "fibers/posix/signals/cancellation.hpp"
#include "fibers/posix/sync/futex.hpp"
#include "fibers/posix/sync/futex_vectors.hpp"
#include "fibers/posix/sync/membarrier.hpp"
#include "fibers/posix/time/clocks.hpp"

namespace waitpoint::posix {
namespace {

long make_timer(clockid_t clock, sigevent* event, int* number) {
  timer_t made = nullptr;
  if (timer_create(clock, event, &made) != 0) return -1;
  WAITPOINT_CHECK(!is_simulated() || reinterpret_cast<std::uintptr_t>(made) <= INT_MAX,
                  "a timer's number does not fit into the system's");
  *number = static_cast<int>(reinterpret_cast<std::uintptr_t>(made));
  return 0;
}

static_assert(sizeof(long) == sizeof(void*) && sizeof(CallWords) == 6 * sizeof(long));

long call_system(long number, const CallWords& words) {
  return WAITPOINT_NEXT(syscall)(number, words.at[0], words.at[1], words.at[2], words.at[3], words.at[4], words.at[5]);
}

bool may_be_written(void* address) { return address == nullptr || can_be_written(address); }

// Each group handles its calls, and returns nullopt for others.

std::optional<long> call_about_threads(long number, const CallWords& words) {
  switch (number) {
    case SYS_futex: return words.call(futex);
    case SYS_futex_waitv: return is_simulated() ? wait_for_any_futex(words) : call_system(number, words);
    case SYS_membarrier: return words.call(membarrier);
    case SYS_gettid: return gettid();
    case SYS_getpid: return getpid();
    case SYS_getppid: return getppid();
    case SYS_getpgrp: return getpgrp();
    case SYS_getpgid: return words.call(getpgid);
    case SYS_setpgid: return words.call(setpgid);
    case SYS_getsid: return words.call(getsid);
    case SYS_setsid: return setsid();
    case SYS_pidfd_open: return words.call(pidfd_open);
    case SYS_kill: return words.call(kill);
    case SYS_pidfd_send_signal: return words.call(pidfd_send_signal);
    case SYS_tgkill: return words.call(tgkill);
    case SYS_tkill: return words.at[0] <= 0 ? fail(EINVAL) : tgkill(getpid(), words.word<pid_t>(0), words.word<int>(1));
    case SYS_rt_sigaction:
    case SYS_rt_sigprocmask:
    case SYS_rt_sigpending:
    case SYS_rt_sigsuspend:
    case SYS_rt_sigtimedwait:
    case SYS_rt_sigqueueinfo:
    case SYS_rt_tgsigqueueinfo:
    case SYS_signalfd:
    case SYS_signalfd4:
    case SYS_ppoll:
    case SYS_pselect6:
    case SYS_epoll_pwait: return call_about_signals(number, words);
    case SYS_sigaltstack: return words.call(sigaltstack);
    case SYS_pause: return pause();
    default: return std::nullopt;
  }
}

std::optional<long> call_about_scheduling(long number, const CallWords& words) {
  switch (number) {
    case SYS_sched_yield: return sched_yield();
    case SYS_setpriority:
      return setpriority(static_cast<__priority_which_t>(words.at[0]), words.word<id_t>(1), words.word<int>(2));
    case SYS_getcpu: return words.call(getcpu);
    case SYS_getrandom: return words.call(getrandom);
    case SYS_getrusage: return getrusage(static_cast<__rusage_who_t>(words.at[0]), words.word<rusage*>(1));
    default: return std::nullopt;
  }
}

std::optional<long> call_about_time(long number, const CallWords& words) {
  const auto timer = reinterpret_cast<timer_t>(static_cast<std::uintptr_t>(words.at[0]));
  switch (number) {
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
    // The functions of these names do not check addresses, as the system does.
    case SYS_gettimeofday: return may_be_written(words.word<void*>(0)) ? words.call(gettimeofday) : fail(EFAULT);
    case SYS_time: return may_be_written(words.word<void*>(0)) ? words.call(time) : fail(EFAULT);
    case SYS_times: return may_be_written(words.word<void*>(0)) ? words.call(times) : fail(EFAULT);
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
    default: return std::nullopt;
  }
}

std::optional<long> call_about_ipc(long number, const CallWords& words) {
  switch (number) {
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
    default: return std::nullopt;
  }
}

std::optional<long> call_about_processes(long number, const CallWords& words) {
  switch (number) {
    case SYS_fork: return fork();
    case SYS_vfork: return vfork();
    case SYS_clone:
    case SYS_clone3:
    case SYS_exit:
    case SYS_set_tid_address: return is_simulated() ? call_about_clones(number, words) : call_system(number, words);
    case SYS_wait4: return words.call(wait4);
    case SYS_waitid:
      return waitid(static_cast<idtype_t>(words.at[0]), words.word<id_t>(1), words.word<siginfo_t*>(2),
                    words.word<int>(3));
    case SYS_execve: return words.call(execve);
    case SYS_exit_group: _exit(words.word<int>(0));
    default: return std::nullopt;
  }
}

std::optional<long> call_about_descriptors(long number, const CallWords& words) {
  switch (number) {
    case SYS_open: return open(words.word<const char*>(0), words.word<int>(1), words.word<mode_t>(2));
    case SYS_openat:
      return openat(words.word<int>(0), words.word<const char*>(1), words.word<int>(2), words.word<mode_t>(3));
    case SYS_fcntl: return fcntl(words.word<int>(0), words.word<int>(1), words.at[2]);
    case SYS_flock: return words.call(flock);
    case SYS_close: return words.call(close);
    case SYS_close_range: return words.call(close_range);
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
    default: return std::nullopt;
  }
}

std::optional<long> call_about_sockets(long number, const CallWords& words) {
  switch (number) {
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
    default: return std::nullopt;
  }
}

// By which memory becomes code.
std::optional<long> call_about_memory(long number, const CallWords& words) {
  switch (number) {
    case SYS_mmap: return words.call(mmap);
    case SYS_mprotect: return words.call(mprotect);
    default: return std::nullopt;
  }
}

// Of the process's memory, which no event is about, of the thread's own state, or of what does not change.
bool has_no_footprint(long number) {
  constexpr long numbers[] = {
      SYS_munmap,          SYS_mremap,          SYS_madvise,    SYS_brk,   SYS_mlock, SYS_munlock,  SYS_rseq,
      SYS_set_robust_list, SYS_get_robust_list, SYS_arch_prctl, SYS_uname, SYS_fsync, SYS_fdatasync};
  return std::find(std::begin(numbers), std::end(numbers), number) != std::end(numbers);
}

}  // namespace

// What a call that goes to the system does is not known here: in an exploration it depends on every other event.
long simulated_call(long number, const CallWords& words) {
  const CancellationDisabled disabled;
  for (const auto about :
       {call_about_threads, call_about_scheduling, call_about_time, call_about_ipc, call_about_processes,
        call_about_descriptors, call_about_sockets, call_about_files, call_about_memory})
    if (const std::optional<long> result = about(number, words)) return *result;
  if (number == SYS_io_uring_setup) note_unrepeatable("io_uring_setup()");
  if (number == SYS_perf_event_open) note_unrepeatable("perf_event_open()");
  if (!has_no_footprint(number)) before_call<"syscall">(changing(place::all));
  return call_system(number, words);
}

}  // namespace waitpoint::posix

using namespace waitpoint::posix;

WAITPOINT_INTERPOSED long syscall(long number, ...) noexcept {
  va_list more;
  va_start(more, number);
  CallWords words;
  for (long& word : words.at) word = va_arg(more, long);
  va_end(more);
  if (is_host_code()) return call_system(number, words);
  return simulated_call(number, words);
}

WAITPOINT_INTERPOSED pid_t gettid() noexcept {
  return is_simulated() ? this_thread().id : static_cast<pid_t>(WAITPOINT_NEXT(syscall)(SYS_gettid));
}
