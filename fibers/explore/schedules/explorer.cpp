// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/schedules/explorer.hpp"

#include <algorithm>
#include <utility>

#include "core/error.hpp"
#include "fibers/explore/strategies/operations.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/kernel/run_window.hpp"

namespace waitpoint::exploration {
namespace {

using kernel::Operation;

constexpr std::uint8_t looks_max = 6;

// More than the loops of common libraries poll before they wait.
constexpr std::uint32_t polls_max = 100;

// The number of turns given while all ready tasks spin, before time advances.
constexpr std::uint32_t idle_yields_max = 20;

constexpr Operations looks(Operation::load, Operation::try_lock, Operation::try_lock_shared, Operation::try_acquire,
                           Operation::try_wait, Operation::compare_exchange, Operation::exchange,
                           Operation::stop_requested, Operation::poll, Operation::sleep, Operation::yield);

}  // namespace

bool is_look(const Task& task) {
  return looks.contain(task.operation) || (task.operation == Operation::call && task.footprint.changes == 0);
}

void Explorer::play(Strategy& strategy, const Played& played) {
  decide_by(strategy);
  played_ = played;
  plays_ = !played.prefix.empty() || !played.switches.empty() || !played.deviations.empty() ||
           played.stop_at != Played().stop_at;
  switches_.clear();
  for (const Switch& change : played.switches) switches_.emplace_back(change, switches_.size());
  std::sort(switches_.begin(), switches_.end());
  deviated_ = 0;
}

void Explorer::begin(Strategy& strategy, const Played& played) {
  play(strategy, played);
  schedule_.decisions.clear();
  schedule_.switches.clear();
  schedule_.cuts_polls_short = false;
  trace_.clear();
  if (relation_ != nullptr) relation_->clear();
  habits_.clear();
  stopped_before_.clear();
  last_ = poller_ = nullptr;
  of_process_ = {};
  times_ = 0;
  spinning_ = idle_turns_ = step_ = step_of_instant_ = instants_ = 0;
  instant_ = Time();
  parted_ = was_cut_ = is_beyond_enumeration_ = has_spun_ = false;
}

// The alternative that `deviations` prescribes for this decision; `count` if there is none.
std::uint32_t Explorer::of_deviations(std::uint32_t count) {
  const std::size_t at = schedule_.decisions.size();
  while (deviated_ < played_.deviations.size() && played_.deviations[deviated_].decision < at) ++deviated_;
  if (deviated_ == played_.deviations.size() || played_.deviations[deviated_].decision != at) return count;
  parted_ |= played_.deviations[deviated_].chosen >= count;
  return std::min(count, played_.deviations[deviated_].chosen);
}

const Decision* Explorer::of_prefix(Choice choice, std::uint32_t count) {
  const std::size_t at = schedule_.decisions.size();
  if (parted_ || at >= played_.prefix.size()) return nullptr;
  const Decision& decision = played_.prefix[at];
  if (decision.choice == choice && decision.count == count) return &decision;
  parted_ = true;
  return nullptr;
}

// The place of that switch among those to play; their number if it is none of them.
std::size_t Explorer::place_of(const Switch& change) const {
  const auto found = std::lower_bound(switches_.begin(), switches_.end(), std::pair(change, std::size_t{0}));
  return found != switches_.end() && found->first == change ? found->second : switches_.size();
}

void Explorer::begin_instant(Time now) {
  instant_ = now;
  step_of_instant_ = 0;
  ++instants_;
  last_ = nullptr;  // its time has advanced like the others': it has no priority to continue
  poller_ = nullptr;
  if (spinning_ != 0) stop_spinning();
  idle_turns_ = 0;
}

// The position of the last running task, usually the last one; the size if it is not offered.
inline std::uint32_t Explorer::place_of_last(std::span<Task* const> offered) const {
  std::size_t place = offered.size();
  while (place > 0 && offered[place - 1] != last_) --place;
  return static_cast<std::uint32_t>(place > 0 ? place - 1 : offered.size());
}

inline void Explorer::record_choice(Task* const* ready, const Decision& decision) {
  schedule_.decisions.push_back(decision);
  if (decision.is_switch())
    schedule_.switches.push_back({Choice::task, event_of(*ready[decision.usual]), event_of(*ready[decision.chosen])});
}

std::uint32_t Explorer::next(Task* const* ready, std::uint32_t count) {
  if (const Time now = kernel::global_time(scheduler_); now != instant_) begin_instant(now);
  if (__builtin_expect(plays_ || spinning_ != 0, 0)) return next_with_care(ready, count);
  if (++step_of_instant_ > steps_max_)
    kernel::stop_between_events(scheduler_, kernel::StopCause::no_progress, *ready[0]);
  const std::uint32_t last = place_of_last({ready, count});
  const bool can_continue = last != count;
  const std::uint32_t chosen = strategy_->next({{ready, count}, last_, can_continue, step_});
  if (__builtin_expect(chosen == Strategy::cut, 0)) return abandon_schedule(*ready[0]);
  if (count > 1) record_choice(ready, {count, chosen, can_continue ? last : 0, Choice::task, can_continue, 0});
  note(*ready[chosen]);
  ++step_;
  return chosen;
}

// Called if a schedule is played, or some tasks spin.
std::uint32_t Explorer::next_with_care(Task* const* ready, std::uint32_t count) {
  if (spinning_ != 0 && polls_only({ready, count}) && ++idle_turns_ > idle_yields_max &&
      kernel::is_due_later(scheduler_)) {
    schedule_.cuts_polls_short = true;
    return later;
  }
  if (++step_of_instant_ > steps_max_)
    kernel::stop_between_events(scheduler_, kernel::StopCause::no_progress, *ready[0]);
  const bool chooses = count > 1;
  const bool some_spin = spinning_ != 0 && chooses;
  const std::span<Task* const> offered = some_spin ? leave_spinning_out({ready, count}) : std::span(ready, count);
  const std::uint32_t last = place_of_last(offered);
  const bool can_continue = last != offered.size();
  const std::uint32_t usual = can_continue ? last : 0;
  const std::uint32_t usual_place = some_spin ? places_[usual] : usual;
  std::uint32_t chosen = count;
  if (plays_ && chooses) {
    if (schedule_.decisions.size() == played_.stop_at) return stop({ready, count}, usual_place);
    chosen = choose({ready, count}, usual_place);
  }
  if (chosen == count && poller_ != nullptr) chosen = place_of_poller({ready, count});
  if (chosen == count) {
    chosen = strategy_->next({offered, last_, can_continue, step_});
    if (some_spin && chosen != Strategy::cut) chosen = places_[chosen];
  }
  if (chosen == Strategy::cut) return abandon_schedule(*ready[0]);
  if (chooses)
    record_choice(ready,
                  {count, chosen, usual_place, Choice::task, can_continue, some_spin ? spinning_among(count) : 0});
  note(*ready[chosen]);
  ++step_;
  return chosen;
}

std::uint32_t Explorer::stop(std::span<Task* const> ready, std::uint32_t usual) {
  stopped_before_.assign(ready.begin(), ready.end());
  kernel::stop_between_events(scheduler_, kernel::StopCause::requested, *ready[usual]);
  return usual;
}

// The run ends here: the returned task is not entered.
std::uint32_t Explorer::abandon_schedule(Task& task) {
  was_cut_ = true;
  kernel::stop_between_events(scheduler_, kernel::StopCause::requested, task);
  return 0;
}

// The played choice; the number of ready tasks if there is none.
std::uint32_t Explorer::choose(std::span<Task* const> ready, std::uint32_t usual) {
  const auto count = static_cast<std::uint32_t>(ready.size());
  if (const Decision* decision = of_prefix(Choice::task, count)) return decision->chosen;
  if (const std::uint32_t chosen = of_deviations(count); chosen != count) return chosen;
  // Several may fit, if the default one is left waiting more than once: then in their order.
  std::size_t first = switches_.size();
  std::uint32_t chosen = count;
  for (std::uint32_t i = 0; i < count && !switches_.empty(); ++i) {
    if (i == usual) continue;
    const std::size_t place = place_of({Choice::task, event_of(*ready[usual]), event_of(*ready[i])});
    if (place < first) chosen = i;
    first = std::min(first, place);
  }
  return chosen;
}

// The tasks among `count` that are not offered, after leave_spinning_out().
std::uint64_t Explorer::spinning_among(std::uint32_t count) const {
  std::uint64_t left = count < 64 ? (std::uint64_t{1} << count) - 1 : ~std::uint64_t{0};
  for (const std::uint32_t place : places_)
    if (place < 64) left &= ~(std::uint64_t{1} << place);
  return left;
}

// The place of the task that goes on alone; the size if its polls are over.
std::uint32_t Explorer::place_of_poller(std::span<Task* const> ready) {
  const auto place = static_cast<std::uint32_t>(std::find(ready.begin(), ready.end(), poller_) - ready.begin());
  if (place < ready.size() && is_look(*poller_) && ++polls_ <= polls_max) return place;
  poller_ = nullptr;
  return static_cast<std::uint32_t>(ready.size());
}

void Explorer::stop_spinning() {
  for (RecentAccesses& habit : habits_) habit.spins = false;
  spinning_ = 0;
}

bool Explorer::polls_only(std::span<Task* const> ready) const {
  for (const Task* task : ready)
    if (task->number >= habits_.size() || !habits_[task->number].spins) return false;
  return true;
}

// Hides spinning tasks from the strategy, and from the default order, while there are others.
std::span<Task* const> Explorer::leave_spinning_out(std::span<Task* const> ready) {
  offered_.clear();
  places_.clear();
  const auto add = [&](std::uint32_t at) {
    offered_.push_back(ready[at]);
    places_.push_back(at);
  };
  for (std::uint32_t i = 0; i < ready.size(); ++i)
    if (ready[i]->number >= habits_.size() || !habits_[ready[i]->number].spins) add(i);
  if (offered_.empty()) {  // all of them spin: another one gets a turn
    stop_spinning();
    for (std::uint32_t i = 0; i < ready.size(); ++i)
      if (ready[i] != last_) add(i);
  }
  return offered_;
}

namespace {

std::uintptr_t accessed_by(const Task& task) {
  const auto object = reinterpret_cast<std::uintptr_t>(task.at);
  return task.operation == Operation::call ? object ^ Digest::mix(task.footprint.reads) : object;
}

}  // namespace

inline void Explorer::note(const Task& task) {
  trace_.add(task, instant_);
  if (__builtin_expect(relation_ != nullptr, 0)) relation_->note(task);
  if (__builtin_expect(task.number >= habits_.size(), 0)) habits_.resize(task.number + 1);
  RecentAccesses& habit = habits_[task.number];
  if (habit.instant != instants_) habit = {.at = {}, .instant = instants_};
  if (is_look(task)) {
    note_look(task, habit);
  } else {
    habit.looks = 0;
    idle_turns_ = 0;
    if (spinning_ != 0) stop_spinning();
  }
  habit.at[1] = habit.at[0];
  habit.at[0] = accessed_by(task);
  last_ = &task;
}

void Explorer::note_look(const Task& task, RecentAccesses& habit) {
  const std::uintptr_t at = accessed_by(task);
  const bool is_another = at != habit.at[0] && at != habit.at[1];
  if (task.operation != Operation::yield) {
    habit.looks = is_another ? 0 : static_cast<std::uint8_t>(habit.looks + 1);
    if (habit.looks < looks_max) return;
    habit.looks = 0;
  }
  if (habit.spins) return;
  habit.spins = has_spun_ = true;
  ++spinning_;
  if (poller_ != nullptr || !strategy_->lets_poll_on()) return;
  poller_ = &task;
  polls_ = 0;
  is_beyond_enumeration_ = true;
}

std::uint32_t Explorer::among(Choice choice, const Task& task, std::uint32_t count) {
  return alternative({count, 0, 0, choice}, task, count, 0);
}

std::uint32_t Explorer::process(const Task& task, std::uint32_t count, std::uint32_t spinning, bool can_continue) {
  WAITPOINT_CHECK(spinning < count, "a choice among processes offers none");
  std::uint64_t places = 0;
  for (std::uint32_t place = count - spinning; place < std::min(count, 64U); ++place)
    places |= std::uint64_t{1} << place;
  times_ = std::exchange(of_process_, event_of(task)) == event_of(task) ? times_ + 1 : 0;
  return alternative({count, 0, 0, Choice::process, can_continue, places}, task, count - spinning, times_);
}

bool Explorer::spin(std::span<Task* const> ready) const {
  return spinning_ != 0 && instant_ == kernel::global_time(scheduler_) && polls_only(ready);
}

void Explorer::note_effect_elsewhere() {
  idle_turns_ = 0;
  if (spinning_ != 0) stop_spinning();
}

void Explorer::take_over(std::span<const Decision> decisions, std::span<const Switch> switches) {
  schedule_.decisions.insert(schedule_.decisions.end(), decisions.begin(), decisions.end());
  schedule_.switches.insert(schedule_.switches.end(), switches.begin(), switches.end());
}

// Makes this decision, whose default is 0; the strategy is offered the first `offered` alternatives. `time`: of several
// such decisions before the same event.
std::uint32_t Explorer::alternative(Decision decision, const Task& task, std::uint32_t offered, std::uint64_t time) {
  const Choice choice = decision.choice;
  const std::uint32_t count = decision.count;
  std::uint32_t chosen = count;
  if (plays_) {
    if (const Decision* const played = of_prefix(choice, count)) chosen = played->chosen;
    if (chosen == count) chosen = of_deviations(count);
    for (std::uint32_t i = 1; i < count && !switches_.empty() && chosen == count; ++i)
      if (place_of({choice, event_of(task), {i, time}}) < switches_.size()) chosen = i;
  }
  if (chosen == count) chosen = offered > 1 ? strategy_->among(choice, task, offered) : 0;
  WAITPOINT_CHECK(chosen < count, "a strategy chose an alternative that does not exist");
  decision.chosen = chosen;
  is_beyond_enumeration_ |= (choice == Choice::spurious && chosen != 0) ||
                            (choice == Choice::computing && chosen != 0 && chosen + 1 != count);
  trace_.add(choice, task, chosen);
  schedule_.decisions.push_back(decision);
  if (decision.is_switch()) schedule_.switches.push_back({choice, event_of(task), {chosen, time}});
  return chosen;
}

namespace {

std::uint32_t costs_between(Duration least, Duration greatest) {
  const std::int64_t span = (greatest - least).ns();
  return span < computing_steps ? static_cast<std::uint32_t>(span) + 1 : computing_steps + 1;
}

}  // namespace

Duration Explorer::cost(Duration least, Duration greatest, std::uint32_t chosen) {
  __extension__ using Wide = __int128;
  const std::uint32_t count = costs_between(least, greatest);
  const auto less = static_cast<Wide>((greatest - least).ns()) * chosen / (count - 1);
  return greatest - Duration::from_ns(static_cast<std::int64_t>(less));
}

Duration Explorer::computing(const Task& task, Duration least, Duration greatest) {
  const std::uint32_t count = costs_between(least, greatest);
  return cost(least, greatest, among(Choice::computing, task, count));
}

}  // namespace waitpoint::exploration
