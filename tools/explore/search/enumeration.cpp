// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/search/enumeration.hpp"

#include "fibers/explore/strategies/dfs.hpp"
#include "fibers/explore/strategies/factory.hpp"
#include "tools/explore/search/depth_first.hpp"
#include "tools/explore/search/partial_order.hpp"

namespace waitpoint::tools {
namespace {

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

Enumeration Enumeration::after_draws(const std::string& strategy) { return {strategy, make_exhaustive(strategy)}; }

bool Enumeration::take(const ProcessFinding& finding) {
  ++number_;
  if (name_ == "dpor" && finding.kind != ProcessFinding::Kind::killed && finding.lesson.progress.empty()) return false;
  next_ = schedules_->after(finding);
  return true;
}

}  // namespace waitpoint::tools
