// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/clock.hpp"

#include "fibers/sync/run_context.hpp"

namespace waitpoint {

system_clock::time_point system_clock::now() {
  return time_point(duration((Duration::from_ns(sync::start_date_ns()) + waitpoint::now().since_start()).ns()));
}

std::int64_t sync::start_date_ns() {
  return RunContext::of(*running_task().scheduler).start_date().time_since_epoch().count();
}

}  // namespace waitpoint
