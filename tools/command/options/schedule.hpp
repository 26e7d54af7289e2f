// SPDX-License-Identifier: BSD-3-Clause
// The seed of runs, and the strategy: the order of what happens at one instant.
#pragma once

#include <cstdint>
#include <optional>

#include "fibers/kernel/chooser.hpp"
#include "tools/command/command.hpp"
#include "tools/command/option_values.hpp"

namespace waitpoint::tools {

struct ScheduleOptions {
  std::uint64_t seed = 1;
  std::optional<SeedRange> seeds = {};  ///< instead of `seed`
  kernel::Order order = kernel::Order::fifo;
};

void declare_seed(Command& command, std::uint64_t& seed, const char* description);
/// `each` tells of the runs of --seeds, `usual` is the word for the default order.
void declare_schedule(Command& command, ScheduleOptions& options, const char* each, const char* usual);
/// Processes at once: --jobs.
void declare_jobs(Command& command, std::uint32_t& jobs);

}  // namespace waitpoint::tools
