// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/report/fewer_switches.hpp"

#include <fmt/format.h>

#include "fibers/explore/schedules/leave_out.hpp"
#include "tools/explore/search/search.hpp"

namespace waitpoint::tools {
namespace {

using exploration::Switch;

// With other switches the same failure may occur somewhat later.
constexpr Duration delay_max = std::chrono::seconds(5);

// Up to this number of switches, leaving one out is also tried with the later ones shifted.
constexpr std::size_t few = 40;

// In runs of up to this number of decisions, all alternatives of each decision are tried.
constexpr std::uint64_t few_decisions = 400;

}  // namespace

FewerSwitches::FewerSwitches(Target& target, SearchProgress& progress, Budget& budget, std::uint64_t number,
                             const Finding& found)
    : target_(target),
      progress_(progress),
      budget_(budget),
      number_(target.has_noise() ? number : 0),
      least_(found),
      until_(found.end + delay_max) {}

std::optional<Finding> FewerSwitches::tried(Plan plan) {
  if (interrupted_ || !budget_.take()) return std::nullopt;
  progress_.update(fmt::format("minimising: {} switches, run {}", least_.switches.size(), budget_.used()));
  plan.drawn = false;
  plan.until = until_;
  std::optional<Finding> finding = run_apart(target_, plan);
  interrupted_ = !finding;
  return finding;
}

bool FewerSwitches::fails(std::uint64_t number, const std::vector<Switch>& switches) {
  std::optional<Finding> finding = tried({.number = number, .switches = switches});
  if (!finding || !is_same_failure(least_, *finding)) return false;
  // Leaving a switch out may cause new ones.
  if (repeats_ && finding->switches.size() > least_.switches.size()) return false;
  number_ = number;
  least_ = std::move(*finding);
  return true;
}

void FewerSwitches::run() {
  if (least_.kind == Finding::Kind::killed) return;  // its choices died with it
  is_noise_ = fails(number_, {});
  if (!is_noise_) {
    repeats_ = fails(number_, least_.switches);
    if (!repeats_) return;
    leave_out();
    if (least_.switches.size() > 1 && least_.decisions <= few_decisions) seek_one();
  }
  if (number_ != 0 && !is_noise_) (void)fails(0, least_.switches);
}

// Tries the default order with a single deviation, at each decision.
void FewerSwitches::seek_one() {
  for (std::uint32_t decision = 0; decision < least_.decisions; ++decision)
    for (std::uint32_t chosen = 0;; ++chosen) {
      std::optional<Finding> finding = tried({.number = number_, .deviations = {{decision, chosen}}});
      if (!finding) return;
      if (finding->parted) break;  // no further alternatives
      if (!is_same_failure(least_, *finding)) continue;
      least_ = std::move(*finding);
      return;
    }
}

// Without a switch, its two tasks may have one event more or less, which shifts the numbers of later switches.
bool FewerSwitches::leave_out_and_move(std::vector<Switch> others, const Switch& gone, std::size_t at) {
  const std::vector<Switch> unmoved = others;
  for (int variant = 0; variant < 9; ++variant) {
    if (variant == 4) continue;  // no shift
    const std::int64_t usual = variant % 3 - 1, instead = variant / 3 - 1;
    for (std::size_t i = at; i < others.size(); ++i) {
      others[i] = unmoved[i];
      for (exploration::EventOf* event : {&others[i].usual, &others[i].instead}) {
        if (event->task == gone.usual.task) event->sequence += static_cast<std::uint64_t>(usual);
        if (event->task == gone.instead.task) event->sequence += static_cast<std::uint64_t>(instead);
      }
    }
    if (fails(number_, others) && least_.switches.size() <= unmoved.size()) return true;
  }
  return false;
}

void FewerSwitches::leave_out() {
  exploration::leave_out([&] { return least_.switches; },
                         [&](const auto& all, const auto& others, std::size_t from, std::size_t size) {
                           if (fails(number_, others) && least_.switches.size() < all.size()) return true;
                           return size == 1 && all.size() <= few && leave_out_and_move(others, all[from], from);
                         });
}

}  // namespace waitpoint::tools
