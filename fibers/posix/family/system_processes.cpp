// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/family/system_processes.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "fibers/posix/base/direct_call.hpp"
#include "fibers/posix/base/error_number.hpp"

namespace waitpoint::posix::family {
namespace {

/// The words of /proc/PID/stat behind the name, which may contain any character; empty if there is no such process.
struct Stat {
  char text[1024] = {};
  const char* state = "";

  explicit Stat(pid_t process) {
    char path[40];
    std::snprintf(path, sizeof path, "/proc/%d/stat", process);
    const long file = call_directly(SYS_openat, AT_FDCWD, reinterpret_cast<long>(path), O_RDONLY | O_CLOEXEC);
    if (file < 0) return;
    const long size = call_directly(SYS_read, file, reinterpret_cast<long>(text), sizeof text - 1);
    call_directly(SYS_close, file);
    text[size > 0 ? size : 0] = '\0';
    if (const char* const behind = std::strrchr(text, ')'); behind != nullptr && behind[1] == ' ') state = behind + 2;
  }
};

}  // namespace

pid_t system_id() { return static_cast<pid_t>(call_directly(SYS_getpid)); }

bool is_running(pid_t process) {
  const ErrorNumberKept kept;
  const Stat stat(process);
  if (*stat.state == '\0')
    return call_directly(SYS_access, reinterpret_cast<long>("/proc/self"), F_OK) != 0 &&
           call_directly(SYS_kill, process, 0) == 0;
  return *stat.state != 'Z' && *stat.state != 'X';
}

int status_of_zombie(pid_t process) {
  const ErrorNumberKept kept;
  const Stat stat(process);
  const char* const last = std::strrchr(stat.state, ' ');
  return *stat.state == 'Z' && last != nullptr ? std::atoi(last + 1) : SIGKILL;
}

}  // namespace waitpoint::posix::family
