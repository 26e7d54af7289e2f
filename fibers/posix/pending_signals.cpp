// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/pending_signals.hpp"

#include <cstdlib>

namespace waitpoint::posix {
namespace {

constexpr int first_queued = 32;  // of the kernel's real-time signals

void let_go(PendingSignal& signal) {
  if (signal.taken != nullptr)
    signal.taken(signal);
  else
    std::free(&signal);
}

}  // namespace

bool PendingSignals::add(PendingSignal& signal) {
  const int number = signal.information.si_signo;
  if (number < first_queued && contains(set_, number)) {
    let_go(signal);
    return false;
  }
  PendingSignal** last = &first_;
  while (*last != nullptr) last = &(*last)->next;
  *last = &signal;
  signal.next = nullptr;
  set_ |= only(number);
  return true;
}

void PendingSignals::count_again(int signal) {
  set_ &= ~only(signal);
  for (const PendingSignal* each = first_; each != nullptr; each = each->next)
    if (each->information.si_signo == signal) set_ |= only(signal);
}

int PendingSignals::take(SignalSet set, siginfo_t& information) {
  const SignalSet among = set_ & set;
  if (among == 0) return 0;
  // What the processor raises comes first.
  const int number = __builtin_ctzll((among & faults) != 0 ? among & faults : among) + 1;
  PendingSignal** link = &first_;
  while ((*link)->information.si_signo != number) link = &(*link)->next;
  PendingSignal& found = **link;
  *link = found.next;
  count_again(number);
  // A timer says then how often it has run out meanwhile.
  if (found.taken != nullptr) found.taken(found);
  information = found.information;
  if (found.taken == nullptr) std::free(&found);
  return number;
}

void PendingSignals::drop(SignalSet set) {
  for (PendingSignal** link = &first_; *link != nullptr;) {
    PendingSignal& each = **link;
    if (!contains(set, each.information.si_signo)) {
      link = &each.next;
      continue;
    }
    *link = each.next;
    let_go(each);
  }
  set_ &= ~set;
}

void PendingSignals::remove(const PendingSignal& signal) {
  for (PendingSignal** link = &first_; *link != nullptr; link = &(*link)->next)
    if (*link == &signal) {
      *link = signal.next;
      count_again(signal.information.si_signo);
      return;
    }
}

}  // namespace waitpoint::posix
