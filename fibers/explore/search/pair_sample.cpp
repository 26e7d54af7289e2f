// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/search/pair_sample.hpp"

#include <algorithm>
#include <cmath>

#include "fibers/explore/strategies/factory.hpp"

namespace waitpoint::exploration {

void PairIncidence::note(Witnesses& witnesses, Schedule schedule) {
  witnesses.last = schedule;
  const std::uint32_t before = witnesses.count;
  witnesses.count = std::min(before + 1, 3u);
  switch (before) {
    case 0:
      witnesses.first = schedule;
      ++pairs_;
      with_unique_ += unique_[schedule]++ == 0;
      break;
    case 1:
      witnesses.second = schedule;
      with_unique_ -= --unique_[witnesses.first] == 0;
      ++shared_[{witnesses.first, schedule}];
      break;
    case 2:
      if (const auto two = shared_.find({witnesses.first, witnesses.second}); --two->second == 0) shared_.erase(two);
      break;
    default: break;
  }
}

void PairIncidence::take(std::span<const ReadsFrom> pairs) {
  const auto schedule = static_cast<Schedule>(unique_.size());
  unique_.push_back(0);
  for (const ReadsFrom& pair : pairs) {
    Witnesses& witnesses = witnesses_[pair.hash()];
    if (witnesses.count == 0 || witnesses.last != schedule) note(witnesses, schedule);
  }
}

std::optional<NewPairChance> PairIncidence::chance() const {
  if (schedules() < 2) return std::nullopt;
  const double count = static_cast<double>(schedules()), estimate = static_cast<double>(with_unique_) / count;
  const auto alike = std::ranges::count_if(
      shared_, [this](const auto& two) { return unique_[two.first.first] == 0 && unique_[two.first.second] == 0; });
  // The roots C of (estimate - C)^2 = q (C (1 - C) + extra).
  constexpr double standard_errors = 1.96;
  const double q = standard_errors * standard_errors / count, extra = 2 * static_cast<double>(alike + 1) / count;
  const double middle = (2 * estimate + q) / (2 * (1 + q));
  const double width = std::sqrt(middle * middle - (estimate * estimate - q * extra) / (1 + q));
  return NewPairChance{.strategy = "",
                       .schedules = schedules(),
                       .pairs = pairs_,
                       .estimate = estimate,
                       .lower_bound = std::max(0.0, middle - width),
                       .upper_bound = std::min(1.0, middle + width)};
}

SampledSchedules::SampledSchedules(const std::string& strategy)
    : strategy_(make_strategy(strategy)), is_random_(strategy != "fifo") {}

std::optional<NewPairChance> PairSample::chance() const {
  std::optional<NewPairChance> chance = at_accesses_.chance();
  const bool is_at_accesses = chance.has_value();
  if (!is_at_accesses) chance = at_calls_.chance();
  if (!chance) return std::nullopt;
  chance->strategy = drawn_by_;
  chance->is_at_accesses = is_at_accesses;
  return chance;
}

}  // namespace waitpoint::exploration
