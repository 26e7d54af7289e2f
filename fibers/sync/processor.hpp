// SPDX-License-Identifier: BSD-3-Clause
// A processor that threads share by fixed priority, preemptively, first in first out within a priority: set in their
// thread_attributes. Their computing times delay each other, and a woken thread must get its processor before it
// continues. Threads without this attribute have a processor each. Destroying it before its threads have ended is a
// bug.
#pragma once

#include "fibers/kernel/processor.hpp"

namespace waitpoint {

class processor {
 public:
  /// `label` is shown in reports; it must outlive the processor, which must outlive the threads that share it.
  explicit constexpr processor(const char* label = "") : core_(label) {}
  ~processor();
  processor(const processor&) = delete;
  processor& operator=(const processor&) = delete;

  kernel::Processor& core() { return core_; }

 private:
  kernel::Processor core_;
};

}  // namespace waitpoint
