// SPDX-License-Identifier: BSD-3-Clause
// While it lives, what is allocated may leak: tasks that never leave never let go of what they own. LeakSanitizer would
// tell it of the whole program.
#pragma once

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>
#endif

namespace waitpoint {

class LeaksOnPurpose {
 public:
#ifdef __SANITIZE_ADDRESS__
  LeaksOnPurpose() { __lsan_disable(); }
  ~LeaksOnPurpose() { __lsan_enable(); }
#else
  LeaksOnPurpose() {}
  ~LeaksOnPurpose() {}
#endif
  LeaksOnPurpose(const LeaksOnPurpose&) = delete;
  LeaksOnPurpose& operator=(const LeaksOnPurpose&) = delete;
};

}  // namespace waitpoint
