// SPDX-License-Identifier: BSD-3-Clause
// Records that hang together by their `next`, from a first one on; null ends them.
#pragma once

namespace waitpoint::posix {

/// Hangs `added` behind all of them.
template <class Record>
void append(Record*& first, Record& added) {
  Record** link = &first;
  while (*link != nullptr) link = &(*link)->next;
  *link = &added;
  added.next = nullptr;
}

/// Takes out the first that is meant; null if none is.
template <class Record, class IsMeant>
Record* take_first(Record*& first, IsMeant is_meant) {
  Record** link = &first;
  while (*link != nullptr && !is_meant(**link)) link = &(*link)->next;
  Record* const taken = *link;
  if (taken != nullptr) *link = taken->next;
  return taken;
}

/// Takes `gone` out, if it is among them.
template <class Record>
void remove(Record*& first, const Record& gone) {
  (void)take_first(first, [&](const Record& each) { return &each == &gone; });
}

}  // namespace waitpoint::posix
