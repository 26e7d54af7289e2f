// SPDX-License-Identifier: BSD-3-Clause
// Disables leak detection during its lifetime: tasks that are never unwound do not release what they own, and
// LeakSanitizer would report it for the whole program.
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
