// SPDX-License-Identifier: BSD-3-Clause
// errno, set and restored as the C library's calls do.
#pragma once

#include <cerrno>

#include "core/error.hpp"

namespace waitpoint::posix {

/// Sets errno; returns the result of a failed call.
inline int fail(int error) {
  WAITPOINT_CHECK(error > 0, "a call fails without an error");
  errno = error;
  return -1;
}

/// Restores errno at the end of its scope, for internal calls whose errors the program must not see.
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
