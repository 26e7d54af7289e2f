// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/analysis/fewer_switches.hpp"

#include <span>
#include <utility>

#include "fibers/explore/schedules/leave_out.hpp"

namespace waitpoint::exploration {
namespace {

// Up to this number of switches, leaving one out is also tried with the later ones shifted.
constexpr std::size_t few = 40;

// In runs of up to this number of decisions, all alternatives of each decision are tried.
constexpr std::uint64_t few_decisions = 400;

// The deviations of a path before a decision, with another alternative there.
std::vector<Deviation> deviating(std::span<const Decision> path, std::size_t at, std::uint32_t other) {
  std::vector<Deviation> deviations;
  for (std::size_t i = 0; i < at; ++i)
    if (path[i].is_switch()) deviations.push_back({static_cast<std::uint32_t>(i), path[i].chosen});
  deviations.push_back({static_cast<std::uint32_t>(at), other});
  return deviations;
}

}  // namespace

FewerSwitches::FewerSwitches(Trials& trials, std::uint64_t number, const Finding& found)
    : trials_(trials),
      number_(trials.traits().has_noise ? number : 0),
      least_(found),
      until_(trials.traits().latest(found)) {}

std::optional<Finding> FewerSwitches::tried(Plan plan, const WantedEvidence& wanted) {
  plan.number = number_;
  plan.drawn = false;
  plan.until = until_;
  return trials_.run(plan, wanted,
                     [&] { return "minimising: " + std::to_string(least_.switches.size()) + " switches"; });
}

// Nothing if it passes, or fails in another way.
std::optional<Finding> FewerSwitches::failing(const Plan& plan) {
  std::optional<Finding> finding = tried(plan);
  if (finding && !is_same_failure(least_, *finding)) finding.reset();
  return finding;
}

// Leaving a switch out may cause new ones.
bool FewerSwitches::fails(std::uint64_t number, const std::vector<Switch>& switches, std::size_t switches_max) {
  const std::uint64_t before = std::exchange(number_, number);
  std::optional<Finding> finding = failing({.switches = switches});
  if (!finding || finding->switches.size() > switches_max) {
    number_ = before;
    return false;
  }
  least_ = std::move(*finding);
  return true;
}

void FewerSwitches::run() {
  constexpr std::size_t any = ~std::size_t{0};
  if (least_.kind == RunVerdict::Kind::killed) return;  // its choices died with it
  const bool is_cheap = trials_.traits().is_cheap;
  is_noise_ = fails(number_, {}, any);
  if (!is_noise_) {
    // Expressed as switches of tasks and events it may be another run: then it stays as it was found.
    repeats_ = fails(number_, least_.switches, any);
    if (!repeats_ && !is_cheap) return;
    const std::size_t searched_max = is_cheap ? 2 : least_.decisions <= few_decisions ? 1 : 0;
    do leave_out();
    while (is_cheap && least_.switches.size() > searched_max && replace_two_by_one());
    for (std::size_t count = 1; count <= searched_max && count < least_.switches.size(); ++count)
      if (search({}, 0, count)) break;
  }
  if (number_ != 0 && !is_noise_) (void)fails(0, least_.switches, least_.switches.size());
}

// Without a switch, its two tasks may have one event more or less, which shifts the numbers of later switches.
bool FewerSwitches::leave_out_and_move(std::vector<Switch> others, const Switch& gone, std::size_t at) {
  const std::vector<Switch> unmoved = others;
  for (int variant = 0; variant < 9; ++variant) {
    if (variant == 4) continue;  // no shift
    const std::int64_t usual = variant % 3 - 1, instead = variant / 3 - 1;
    for (std::size_t i = at; i < others.size(); ++i) {
      others[i] = unmoved[i];
      for (EventOf* event : {&others[i].usual, &others[i].instead}) {
        if (event->task == gone.usual.task) event->sequence += static_cast<std::uint64_t>(usual);
        if (event->task == gone.instead.task) event->sequence += static_cast<std::uint64_t>(instead);
      }
    }
    if (fails(number_, others, unmoved.size())) return true;
  }
  return false;
}

void FewerSwitches::leave_out() {
  const bool moves = !trials_.traits().is_cheap;
  exploration::leave_out([&] { return least_.switches; },
                         [&](const auto& all, const auto& others, std::size_t from, std::size_t size) {
                           if (fails(number_, others, all.size() - 1)) return true;
                           return moves && size == 1 && all.size() <= few &&
                                  leave_out_and_move(others, all[from], from);
                         });
}

// Replaces two switches by one anywhere: where none can be left out, an earlier one may have the effect of both.
bool FewerSwitches::replace_two_by_one() {
  const std::vector<Switch> kept = least_.switches;
  for (std::size_t i = 0; i + 1 < kept.size(); ++i)
    for (std::size_t j = i + 1; j < kept.size(); ++j) {
      std::vector<Switch> others;
      for (std::size_t k = 0; k < kept.size(); ++k)
        if (k != i && k != j) others.push_back(kept[k]);
      if (replace(others)) return true;
      if (trials_.is_over()) return false;
    }
  return false;
}

// Tries these switches, then with one more anywhere.
bool FewerSwitches::replace(const std::vector<Switch>& others) {
  const std::size_t kept = least_.switches.size();
  std::optional<Finding> without = tried({.switches = others}, {.choices = true});
  if (!without) return false;
  const std::vector<Decision> path = std::move(without->lesson.choices);
  if (is_same_failure(least_, *without)) {
    least_ = std::move(*without);
    return true;
  }
  for (std::size_t at = 0; at < path.size(); ++at)
    for (std::uint32_t other = 0; other < path[at].count; ++other) {
      if (other == path[at].chosen) continue;
      std::optional<Finding> with = failing({.switches = others, .deviations = deviating(path, at, other)});
      if (trials_.is_over()) return false;
      if (!with || with->switches.size() >= kept) continue;
      least_ = std::move(*with);
      return true;
    }
  return false;
}

// All schedules with these deviations before decision `from`, that then differ `count` times from the default order.
bool FewerSwitches::search(const std::vector<Deviation>& before, std::size_t from, std::size_t count) {
  std::optional<Finding> usual = tried({.deviations = before}, {.choices = true});
  if (!usual) return false;
  const std::vector<Decision> path = std::move(usual->lesson.choices);
  if (is_same_failure(least_, *usual)) {
    least_ = std::move(*usual);
    return true;
  }
  for (std::size_t at = from; at < path.size(); ++at)
    for (std::uint32_t other = 0; other < path[at].count; ++other) {
      if (other == path[at].chosen) continue;
      const std::vector<Deviation> changed = deviating(path, at, other);
      if (count > 1) {
        if (search(changed, at + 1, count - 1)) return true;
      } else if (std::optional<Finding> failed = failing({.deviations = changed})) {
        least_ = std::move(*failed);
        return true;
      }
      if (trials_.is_over()) return false;
    }
  return false;
}

}  // namespace waitpoint::exploration
