// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/schedules/course.hpp"

#include "core/error.hpp"
#include "fibers/explore/schedules/continuation.hpp"
#include "fibers/explore/strategies/dpor.hpp"
#include "fibers/explore/strategies/factory.hpp"
#include "fibers/explore/strategies/fifo.hpp"

namespace waitpoint::exploration {

std::unique_ptr<Strategy> begin_course(const Course& course, const Explorer& explorer, const Profile& profile) {
  std::unique_ptr<Strategy> strategy;
  std::string stream = course.strategy;
  if (!course.strategy.empty()) {
    strategy = make_strategy(course.strategy);
    strategy->hold(course.constraints);
    if (!course.progress.empty()) {
      WAITPOINT_CHECK(course.strategy == "dpor", "another strategy than dpor is to be resumed");
      static_cast<Dpor&>(*strategy).resume(course.progress);
    }
  } else if (course.at_random_from) {
    strategy = std::make_unique<Continuation>(explorer, *course.at_random_from);
    stream = "continuation";
  } else {
    strategy = std::make_unique<Fifo>();
  }
  strategy->begin(course.number, Draws(course.seed, stream, course.number), profile);
  return strategy;
}

}  // namespace waitpoint::exploration
