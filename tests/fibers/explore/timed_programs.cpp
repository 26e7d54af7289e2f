// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fibers/explore/timed_programs.hpp"

#include "fibers/sync/clock.hpp"

namespace waitpoint::timed {

void Times::spend(std::int64_t least_us, std::int64_t greatest_us) {
  const kernel::Task& task = sync::running_task();
  spent_.push_back({task.id, task.sequence, least_us, greatest_us});
  if (mode_ == Mode::untimed) return;
  compute(Duration(std::chrono::microseconds(least_us)), Duration(std::chrono::microseconds(greatest_us)));
}

void Times::critical(std::int64_t least_us, std::int64_t greatest_us, std::int64_t wider_us) {
  spend(least_us, mode_ == Mode::widened ? wider_us : greatest_us);
}

std::vector<Program> programs() {
  std::vector<Program> all = orders;
  all.insert(all.end(), exclusions.begin(), exclusions.end());
  return all;
}

}  // namespace waitpoint::timed
