// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/minimize.hpp"

#include <algorithm>
#include <optional>
#include <string_view>

#include "fibers/explore/schedules/leave_out.hpp"
#include "fibers/explore/strategies/fifo.hpp"

namespace waitpoint::exploration {
namespace {

// Schedules with up to this many switches are searched exhaustively.
constexpr std::size_t searched_max = 2;

// The first line without the task and the time of an escaped exception.
std::string_view words_of(std::string_view text) {
  text = text.substr(0, text.find('\n'));
  const std::size_t said = text.find(" s: ");
  return said == std::string_view::npos ? text : text.substr(said);
}

class Minimizer {
 public:
  Minimizer(Body& body, const Failure& found, Effort effort) : body_(body), least_(found), effort_(effort) {}

  Failure run() {
    // Expressed as switches of tasks and events it may be another run: then it stays as it was found.
    if (const auto again = fails_with(least_.schedule.switches)) least_ = *again;
    do leave_out_switches();
    while (switches() > searched_max && replace_two_by_one());
    for (std::size_t count = 1; count <= searched_max && count < switches(); ++count)
      if (const auto fewer = search({}, 0, count)) least_ = *fewer;
    return least_;
  }

 private:
  std::size_t switches() const { return least_.schedule.switches.size(); }

  std::optional<Failure> failing(const Played& played) {
    if (!effort_.is_left()) return std::nullopt;
    Fifo rest;
    Failure tried;
    tried.outcome = body_.run(rest, played);
    effort_.spend(body_);
    tried.schedule = body_.explorer().schedule();
    passed_ = tried.schedule;
    if (!is_same_failure(tried.outcome, least_.outcome)) return std::nullopt;
    return tried;
  }
  std::optional<Failure> fails_with(const std::vector<Switch>& switches) { return failing({.switches = switches}); }

  void leave_out_switches() {
    leave_out([&] { return least_.schedule.switches; },
              [&](const auto& kept, const auto& others, std::size_t, std::size_t) {
                const auto still = fails_with(others);
                if (!still || still->schedule.switches.size() >= kept.size()) return false;
                least_ = *still;
                return true;
              });
  }

  // Replaces two switches by one anywhere: where none can be left out, an earlier one may have the effect of both.
  bool replace_two_by_one() {
    const std::vector<Switch> kept = least_.schedule.switches;
    for (std::size_t i = 0; i + 1 < kept.size(); ++i)
      for (std::size_t j = i + 1; j < kept.size(); ++j) {
        std::vector<Switch> others;
        for (std::size_t k = 0; k < kept.size(); ++k)
          if (k != i && k != j) others.push_back(kept[k]);
        if (const auto failed = fails_with(others)) {
          least_ = *failed;
          return true;
        }
        const std::vector<Decision> path = passed_.decisions;
        for (std::size_t at = 0; at < path.size(); ++at) {
          std::vector<Decision> changed(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(at) + 1);
          for (std::uint32_t other = 0; other < path[at].count; ++other) {
            if (!effort_.is_left()) return false;
            if (other == path[at].chosen) continue;
            changed.back().chosen = other;
            const auto failed = failing({.prefix = changed, .switches = others});
            if (!failed || failed->schedule.switches.size() >= kept.size()) continue;
            least_ = *failed;
            return true;
          }
        }
      }
    return false;
  }

  // All schedules that follow `prefix` up to `from`, and then differ `count` times from the default order.
  std::optional<Failure> search(std::vector<Decision> prefix, std::size_t from, std::size_t count) {
    prefix.resize(from);
    if (auto failed = failing({.prefix = prefix})) return failed;
    const std::vector<Decision> path = passed_.decisions;
    for (std::size_t i = from; i < path.size() && effort_.is_left(); ++i) {
      std::vector<Decision> changed(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(i) + 1);
      for (std::uint32_t other = 0; other < path[i].count; ++other) {
        if (other == path[i].chosen) continue;
        changed.back().chosen = other;
        if (count > 1) {
          if (auto failed = search(changed, i + 1, count - 1)) return failed;
        } else if (auto failed = failing({.prefix = changed})) {
          return failed;
        }
      }
    }
    return std::nullopt;
  }

  Body& body_;
  Failure least_;
  Effort effort_;
  Schedule passed_;  // of the last run
};

}  // namespace

bool is_same_failure(const Outcome& a, const Outcome& b) {
  if (a.passed() || b.passed()) return false;
  if (a.end != b.end || a.only_raced != b.only_raced) return false;
  // Reports of deadlocks and of no progress name places and times, which differ from schedule to schedule.
  if (a.end != RunEnd::ended) return true;
  return words_of(a.failure) == words_of(b.failure);
}

Failure minimize(Body& body, const Failure& found, Effort effort) { return Minimizer(body, found, effort).run(); }

}  // namespace waitpoint::exploration
