// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/strategies/go_explore.hpp"

#include <algorithm>

namespace waitpoint::exploration {

void GoExplore::start(const Profile& profile) {
  ++schedules_;
  priorities_.clear(profile.memory);
  state_.clear();
  choices_.clear();
  passed_.clear();
  way_length_ = 0;
  if (kept_.empty() || draw(one_in_from_start) == 0) return;
  Kept& one = rare_one();
  ++one.times;
  way_ = one.choices;
  way_length_ = one.length;
}

// Of some kept ones, the one that the fewest schedules passed.
GoExplore::Kept& GoExplore::rare_one() {
  Kept* rarest = nullptr;
  for (int i = 0; i < compared; ++i) {
    Kept& one = kept_[draw(kept_.size())];
    if (rarest == nullptr || one.times < rarest->times) rarest = &one;
  }
  return *rarest;
}

// True if the next choice, of `count` alternatives, is one that the schedule repeats. In a body that leaks state it may
// have fewer alternatives than it had.
bool GoExplore::returns(std::uint32_t count) {
  const std::size_t at = choices_.size();
  if (at < way_length_ && (*way_)[at] >= count) way_length_ = at;
  return at < way_length_;
}

template <class Drawing>
std::uint32_t GoExplore::choose(std::uint32_t count, Drawing drawing) {
  const std::uint32_t chosen = returns(count) ? (*way_)[choices_.size()] : drawing();
  choices_.push_back(chosen);
  return chosen;
}

std::uint32_t GoExplore::next(const SwitchPoint& at) {
  std::uint32_t chosen = 0;
  if (at.ready.size() > 1)
    chosen = choose(static_cast<std::uint32_t>(at.ready.size()), [&] {
      passed_.push_back({state_.at(at), choices_.size()});
      return priorities_.next(at, draws_, [](const Task&) { return true; });
    });
  state_.note(*at.ready[chosen]);
  return chosen;
}

std::uint32_t GoExplore::among(Choice choice, const Task& task, std::uint32_t count) {
  return choose(count, [&] { return Drawn::among(choice, task, count); });
}

bool GoExplore::lets_poll_on() {
  return choose(2, [&] { return std::uint32_t{Drawn::lets_poll_on()}; }) != 0;
}

// In place of any other, if there is no room.
void GoExplore::keep(const Passed& passed, const std::shared_ptr<const Choices>& choices) {
  const Kept one{passed.state, choices, passed.length, 1, schedules_};
  const std::size_t room = std::clamp<std::size_t>(choices_max / (choices->size() + 1), 1, kept_max);
  std::size_t at = kept_.size();
  if (at < room) {
    kept_.push_back(one);
  } else {
    at = draw(kept_.size());
    place_.erase(kept_[at].state);
    kept_[at] = one;
  }
  place_[passed.state] = at;
}

bool GoExplore::end() {
  std::shared_ptr<const Choices> choices;  // shared by the states that are new
  for (const Passed& passed : passed_) {
    const auto known = place_.find(passed.state);
    if (known == place_.end()) {
      if (choices == nullptr) choices = std::make_shared<const Choices>(choices_);
      keep(passed, choices);
      continue;
    }
    Kept& one = kept_[known->second];
    if (one.last != schedules_) ++one.times;
    one.last = schedules_;
  }
  return true;
}

}  // namespace waitpoint::exploration
