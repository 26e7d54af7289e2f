// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/exec/process_choices.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "fibers/kernel/common_order.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/posix/family/order.hpp"
#include "fibers/posix/family/processes.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/reruns/snapshot.hpp"

namespace waitpoint::posix {
namespace {

using family::Process;

SharedSchedule& shared_schedule() {
  auto* const shared = static_cast<SharedSchedule*>(family::common(family::Part::schedule, sizeof(SharedSchedule)));
  if (shared == nullptr) refuse("there is no memory for the schedule of several processes");
  return *shared;
}

template <class T>
void append(SharedSequence<T>& sequence, std::span<const T> more) {
  if (more.empty()) return;
  if (sequence.count + more.size() > sequence.room) {
    const std::size_t room = std::max<std::size_t>(2 * (sequence.count + more.size()), 1024);
    T* const moved = static_cast<T*>(family::take(room * sizeof(T)));
    if (moved == nullptr) refuse("the schedule of this run is too long to be written down");
    std::copy(sequence.values, sequence.values + sequence.count, moved);
    if (sequence.values != nullptr) family::give(sequence.values);
    sequence.values = moved;
    sequence.room = static_cast<std::uint32_t>(room);
  }
  std::copy(more.begin(), more.end(), sequence.values + sequence.count);
  sequence.count += static_cast<std::uint32_t>(more.size());
}

template <class T>
std::span<const T> rest_of(const SharedSequence<T>& sequence, std::size_t from) {
  return sequence.all().subspan(std::min<std::size_t>(from, sequence.count));
}

/// Scope of a choice of this process: before it those of the others are taken over, afterwards it is added.
class SharedChoice {
 public:
  explicit SharedChoice(exploration::Explorer& explorer) : explorer_(explorer), is_shared_(family::family->made > 1) {
    if (!is_shared_) return;
    const exploration::Schedule& own = explorer_.schedule();
    const SharedSchedule& all = shared_schedule();
    explorer_.take_over(rest_of(all.decisions, own.decisions.size()), rest_of(all.switches, own.switches.size()));
  }
  ~SharedChoice() {
    if (!is_shared_) return;
    const exploration::Schedule& own = explorer_.schedule();
    SharedSchedule& all = shared_schedule();
    append(all.decisions, std::span(own.decisions).subspan(all.decisions.count));
    append(all.switches, std::span(own.switches).subspan(all.switches.count));
    all.cuts_polls_short = all.cuts_polls_short || own.cuts_polls_short;
    all.parted = all.parted || explorer_.parted();
  }
  SharedChoice(const SharedChoice&) = delete;
  SharedChoice& operator=(const SharedChoice&) = delete;

 private:
  exploration::Explorer& explorer_;
  bool is_shared_;
};

bool is_of_tasks(const kernel::EventKey& key) { return kernel::phase_of(key.order) >= kernel::Phase::tasks; }

}  // namespace

// Notes if all these tasks of this process, ready at the present instant, spin.
void ProcessChoices::note_spinning(std::span<kernel::Task* const> ready) {
  SharedSchedule& shared = shared_schedule();
  if (effects_ != shared.effects) explorer_.note_effect_elsewhere();
  effects_ = shared.effects;
  shared.spinning[family::index_of(*family::own)] = {kernel::global_time(scheduler_),
                                                     explorer_.spin(ready) ? shared.effects + 1 : 0};
}

// Among the processes with a task's event at the present instant, and this one if it can stay; those that spin last.
Process* ProcessChoices::choose(bool can_stay) {
  Process& own = *family::own;
  SharedSchedule& shared = shared_schedule();
  const Process& last = family::family->processes[shared.last];
  const Time now = can_stay ? kernel::global_time(scheduler_) : family::least_of_others().time;
  std::vector<Process*> candidates, spinning;
  for (Process& process : family::entries()) {
    const kernel::EventKey key =
        &process == &own ? kernel::EventKey{now, kernel::make_order(kernel::Phase::tasks, 0)} : family::key_of(process);
    const bool is_due = &process == &own ? can_stay : key.time <= now && is_of_tasks(key);
    if (!is_due) continue;
    const SharedSchedule::Spinning& mark = shared.spinning[family::index_of(process)];
    if (mark.at == now && mark.effects == shared.effects + 1) {
      spinning.push_back(&process);
      continue;
    }
    // The default comes first.
    const bool is_default = &process == &last || (&process == &own && (candidates.empty() || candidates[0] != &last));
    candidates.insert(is_default ? candidates.begin() : candidates.end(), &process);
  }
  if (candidates.empty()) {  // all of them spin: another one gets a turn
    std::erase(spinning, can_stay ? &own : nullptr);
    for (const Process* const process : spinning) shared.spinning[family::index_of(*process)].effects = 0;
    std::swap(candidates, spinning);
    if (can_stay) (candidates.empty() ? candidates : spinning).push_back(&own);
  }
  const auto left = static_cast<std::uint32_t>(spinning.size());
  candidates.insert(candidates.end(), spinning.begin(), spinning.end());
  const kernel::Task* const task = kernel::first_task(scheduler_);
  if (candidates.size() < 2 || task == nullptr) return candidates.empty() ? nullptr : candidates[0];
  const SharedChoice choice(explorer_);
  const bool can_continue = candidates[0] == &last;
  if (narrator_ == nullptr)
    return candidates[explorer_.process(*task, static_cast<std::uint32_t>(candidates.size()), left, can_continue)];
  std::vector<const char*> names;
  names.reserve(candidates.size());
  for (const Process* const process : candidates) names.push_back(process->name);
  return candidates[narrator_->process(*task, names, left, can_continue)];
}

std::uint32_t ProcessChoices::next(kernel::Task* const* ready, std::uint32_t count) {
  if (process_ != family::own->id) {
    process_ = family::own->id;
    if (!family::is_first()) begin_in_process_();
  }
  const bool is_alone = !family::has_others();
  if (count > 1) offer_snapshot(explorer_);
  if (!is_alone) note_spinning({ready, count});
  if (!is_alone && !std::exchange(family::own->is_chosen, false)) {
    if (Process* const process = choose(true); process != family::own) {
      chosen_ = process;
      return elsewhere;
    }
  }
  if (family::family->made > 1) shared_schedule().last = family::index_of(*family::own);
  const SharedChoice choice(explorer_);
  const std::uint32_t chosen = decisions_.next(ready, count);
  if (!is_alone && chosen < count && !exploration::is_look(*ready[chosen])) effects_ = ++shared_schedule().effects;
  return chosen;
}

std::uint32_t ProcessChoices::among(kernel::Choice choice, const kernel::Task& task, std::uint32_t count) {
  const SharedChoice shared(explorer_);
  return decisions_.among(choice, task, count);
}

Duration ProcessChoices::computing(const kernel::Task& task, Duration least, Duration greatest) {
  const SharedChoice shared(explorer_);
  return decisions_.computing(task, least, greatest);
}

Process* ProcessChoices::take_chosen() {
  if (chosen_ != nullptr) return std::exchange(chosen_, nullptr);
  family::remove_limit(scheduler_);  // it is no event of this process
  const kernel::EventKey least = family::least_of_others();
  if (least.time == Time::max() || !is_of_tasks(least) || kernel::next_key(scheduler_).time <= least.time)
    return nullptr;
  if (family::family->now < least.time) family::family->now = least.time;
  return choose(false);
}

}  // namespace waitpoint::posix
