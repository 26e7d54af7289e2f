// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command/options/schedule.hpp"

namespace waitpoint::tools {

void declare_seed(Command& command, std::uint64_t& seed, const char* description) {
  command.section("Seed and strategy");
  command.add("--seed", whole(seed, std::uint64_t{0}, ~std::uint64_t{0}), description,
              {.usual = "1", .environment = "WAITPOINT_SEED"});
}

void declare_schedule(Command& command, ScheduleOptions& options, const char* each, const char* usual) {
  declare_seed(command, options.seed, "seed of all that is random");
  command.add("--seeds", seed_range(options.seeds), each);
  command.add("--strategy",
              word<kernel::Order>(options.order, {{"fifo", kernel::Order::fifo}, {"random", kernel::Order::seeded}}),
              "order at one instant: as it came, or drawn by the seed",
              {.usual = usual, .former = "--order", .former_values = {{"seeded", "random"}}});
  command.rules.push_back({"--seeds", Rule::Kind::excludes, {"--seed"}});
}

void declare_jobs(Command& command, std::uint32_t& jobs) {
  command.add("--jobs", whole(jobs, 1u, 1024u), "runs at once, each in a process of its own", {.usual = "1"});
}

}  // namespace waitpoint::tools
