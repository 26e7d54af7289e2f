// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/program/pending_signals.hpp"

#include <cstdlib>

#include "core/error.hpp"

namespace waitpoint::posix {
namespace {

constexpr int first_queued = 32;  // the first real-time signal of the kernel
static_assert(SIGSYS < first_queued, "the kernel's real-time signals follow the others");

void let_go(PendingSignal& signal) {
  if (signal.taken != nullptr)
    signal.taken(signal);
  else
    std::free(&signal);
}

}  // namespace

bool PendingSignals::add(PendingSignal& signal) {
  const int number = signal.information.si_signo;
  WAITPOINT_CHECK((first_ == nullptr) == (last_ == nullptr) && (first_ == nullptr) == (set_ == 0),
                  "the list of pending signals and its set disagree");
  WAITPOINT_CHECK(last_ == nullptr || (last_->next == nullptr && last_ != &signal), "a pending signal is sent again");
  if (number < first_queued && contains(set_, number)) {
    let_go(signal);
    return false;
  }
  (last_ == nullptr ? first_ : last_->next) = &signal;
  last_ = &signal;
  signal.next = nullptr;
  set_ |= only(number);
  return true;
}

PendingSignal& PendingSignals::take_out_behind(PendingSignal* before) {
  PendingSignal*& link = before == nullptr ? first_ : before->next;
  WAITPOINT_CHECK(link != nullptr, "a pending signal is to be removed from behind the last one");
  PendingSignal& found = *link;
  WAITPOINT_CHECK(contains(set_, found.information.si_signo), "a pending signal is not in the set");
  link = found.next;
  if (last_ == &found) last_ = before;
  const int number = found.information.si_signo;
  const PendingSignal* other = first_;
  while (other != nullptr && other->information.si_signo != number) other = other->next;
  if (other == nullptr) set_ &= ~only(number);
  WAITPOINT_CHECK((first_ == nullptr) == (last_ == nullptr) && (first_ == nullptr) == (set_ == 0),
                  "the list of pending signals and its set disagree");
  return found;
}

int PendingSignals::take(SignalSet set, siginfo_t& information) {
  const SignalSet among = set_ & set;
  if (among == 0) return 0;
  // Faults first.
  const int number = __builtin_ctzll((among & faults) != 0 ? among & faults : among) + 1;
  PendingSignal* before = nullptr;
  for (PendingSignal* each = first_; each != nullptr && each->information.si_signo != number; each = each->next)
    before = each;
  PendingSignal& found = take_out_behind(before);
  // A timer adds its overruns at this point.
  if (found.taken != nullptr) found.taken(found);
  information = found.information;
  if (found.taken == nullptr) std::free(&found);
  return number;
}

void PendingSignals::drop(SignalSet set) {
  PendingSignal* before = nullptr;
  for (PendingSignal *each = first_, *next = nullptr; each != nullptr; each = next) {
    next = each->next;
    if (contains(set, each->information.si_signo))
      let_go(take_out_behind(before));
    else
      before = each;
  }
}

void PendingSignals::remove(const PendingSignal& signal) {
  PendingSignal* before = nullptr;
  for (PendingSignal* each = first_; each != nullptr; before = each, each = each->next)
    if (each == &signal) {
      take_out_behind(before);
      return;
    }
}

}  // namespace waitpoint::posix
