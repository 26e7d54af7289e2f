// SPDX-License-Identifier: BSD-3-Clause
// errno, as calls of the C library leave it.
#pragma once

#include <cerrno>

namespace waitpoint::posix {

/// What a call returns that failed, with errno set.
inline int fail(int error) {
  errno = error;
  return -1;
}

/// While it lives, what is done in a call beside what was asked for; errno is not to tell of that.
class ErrorNumberKept {
 public:
  ErrorNumberKept() = default;
  ~ErrorNumberKept() { errno = error_; }
  ErrorNumberKept(const ErrorNumberKept&) = delete;
  ErrorNumberKept& operator=(const ErrorNumberKept&) = delete;

 private:
  int error_ = errno;
};

}  // namespace waitpoint::posix
