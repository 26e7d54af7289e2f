// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/search/enumeration.hpp"

#include "fibers/explore/strategies/dfs.hpp"
#include "fibers/explore/strategies/factory.hpp"
#include "tools/explore/search/depth_first.hpp"
#include "tools/explore/search/partial_order.hpp"

namespace waitpoint::tools {
namespace {

constexpr const char* by_partial_orders = "dpor";
constexpr const char* depth_first = "dfs";

// Null if the strategy is not exhaustive.
std::unique_ptr<Exhaustive> make_exhaustive(const std::string& name) {
  const auto strategy = exploration::make_strategy(name);
  if (const auto* const dfs = dynamic_cast<const exploration::Dfs*>(strategy.get()))
    return std::make_unique<DepthFirst>(dfs->preemptions(), dfs->scope());
  if (dynamic_cast<const exploration::Dpor*>(strategy.get()) != nullptr) return std::make_unique<PartialOrder>();
  return nullptr;
}

}  // namespace

std::optional<Enumeration> Enumeration::of_options(const std::string& strategy) {
  std::unique_ptr<Exhaustive> schedules = make_exhaustive(strategy);
  if (schedules == nullptr) return std::nullopt;
  return Enumeration("", std::move(schedules));
}

Enumeration Enumeration::after_draws(bool has_races) {
  const std::string name = has_races ? depth_first : by_partial_orders;
  return {name, make_exhaustive(name)};
}

void Enumeration::take(const Finding& finding) {
  ++number_;
  // Several processes.
  const bool is_impossible =
      name_ == by_partial_orders && finding.kind != Finding::Kind::killed && finding.progress.empty();
  if (is_impossible)
    begin_another();
  else
    next_ = schedules_->after(finding);
}

bool Enumeration::begin_another() {
  if (name_ != by_partial_orders) return false;
  name_ = depth_first;
  schedules_ = make_exhaustive(name_);
  next_ = schedules_->first();
  number_ = 0;
  return true;
}

}  // namespace waitpoint::tools
