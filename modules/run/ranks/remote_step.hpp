// SPDX-License-Identifier: BSD-3-Clause
// The world's releases of the bridge of a robot whose tasks are on another rank: the events of the environment are the
// same on all ranks.
#pragma once

#include <cstdint>

#include "fibers/kernel/task.hpp"
#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/sync/blocking.hpp"
#include "fibers/sync/object.hpp"

namespace waitpoint::run {

/// The label of the semaphore, there and here.
inline constexpr const char* step_label = "world step";

class RemoteStep {
 public:
  /// The object that is the `number`-th of this robot, where its tasks are.
  void adopt(kernel::Robot& robot, std::uint32_t number) {
    kernel::adopt_as(*robot.scheduler, object_, robot, number);
    is_known_ = true;
  }
  /// From the world's task; after adopt().
  void release() {
    WAITPOINT_CHECK(is_known_, "the number of another rank's semaphore is not known");
    sync::before_releasing(kernel::Operation::release, object_);
  }

 private:
  sync::Object object_{"semaphore", step_label};
  bool is_known_ = false;
};

}  // namespace waitpoint::run
