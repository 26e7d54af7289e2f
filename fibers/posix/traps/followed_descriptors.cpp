// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/traps/followed_descriptors.hpp"

#include <sys/syscall.h>

#include <algorithm>
#include <iterator>

#include "core/error.hpp"
#include "fibers/posix/base/direct_call.hpp"

namespace waitpoint::posix {
namespace {

constexpr std::size_t opened_max = 256, at_once = 2;
int opened[opened_max];
std::size_t opened_count = 0;

int* end_of_opened() { return opened + opened_count; }

void note(int descriptor) {
  WAITPOINT_CHECK(opened_count < opened_max, "a followed call has opened more descriptors than there is room for");
  opened[opened_count++] = descriptor;
}

bool opens(long number) {
  constexpr long all[] = {SYS_open,          SYS_openat,         SYS_pipe,         SYS_pipe2,     SYS_eventfd2,
                          SYS_epoll_create1, SYS_timerfd_create, SYS_memfd_create, SYS_socketpair};
  return std::find(std::begin(all), std::end(all), number) != std::end(all);
}

// Waits take no time.
bool uses(long number, const CallWords& words) {
  switch (number) {
    case SYS_read:
    case SYS_write:
    case SYS_readv:
    case SYS_writev:
    case SYS_pread64:
    case SYS_pwrite64:
    case SYS_lseek:
    case SYS_ftruncate:
    case SYS_getdents64:
    case SYS_ioctl:
    case SYS_sendto:
    case SYS_recvfrom:
    case SYS_sendmsg:
    case SYS_recvmsg:
    case SYS_shutdown:
    case SYS_getsockopt:
    case SYS_setsockopt:
    case SYS_epoll_ctl:
    case SYS_timerfd_settime:
    case SYS_timerfd_gettime:
    case SYS_close: return true;
    case SYS_epoll_wait:
    case SYS_epoll_pwait: return words.word<int>(3) == 0;
    default: return false;
  }
}

}  // namespace

bool is_opened_since(int descriptor) { return std::find(opened, end_of_opened(), descriptor) != end_of_opened(); }

bool is_undone_by_closing(long number, const CallWords& words) {
  if (opens(number)) return opened_count + at_once <= opened_max;
  return uses(number, words) && is_opened_since(words.word<int>(0));
}

void note_descriptors(long number, const CallWords& words, long result) {
  if (number == SYS_close) {
    opened_count = static_cast<std::size_t>(std::remove(opened, end_of_opened(), words.word<int>(0)) - opened);
  } else if (number == SYS_pipe || number == SYS_pipe2 || number == SYS_socketpair) {
    const int* const both = words.word<const int*>(number == SYS_socketpair ? 3 : 0);
    note(both[0]);
    note(both[1]);
  } else if (opens(number)) {
    note(static_cast<int>(result));
  }
}

void close_descriptors_of_run() {
  for (const int* each = opened; each != end_of_opened(); ++each) call_directly(SYS_close, *each);
}

bool has_open_descriptors_of_run() { return opened_count > 0; }

}  // namespace waitpoint::posix
