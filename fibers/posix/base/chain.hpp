// SPDX-License-Identifier: BSD-3-Clause
// Singly linked lists through the member `next` of their records; null ends them.
#pragma once

#include "core/error.hpp"

namespace waitpoint::posix {

/// Appends `added`.
template <class Record>
void append(Record*& first, Record& added) {
  Record** link = &first;
  for (; *link != nullptr; link = &(*link)->next)
    WAITPOINT_FAST_CHECK(*link != &added, "a record is appended to a list that has it");
  *link = &added;
  added.next = nullptr;
}

/// Removes and returns the first record for which `is_meant` is true; null without one.
template <class Record, class IsMeant>
Record* take_first(Record*& first, IsMeant is_meant) {
  Record** link = &first;
  while (*link != nullptr && !is_meant(**link)) link = &(*link)->next;
  Record* const taken = *link;
  if (taken != nullptr) *link = taken->next;
  return taken;
}

/// Removes `gone`, if the list has it.
template <class Record>
void remove(Record*& first, const Record& gone) {
  (void)take_first(first, [&](const Record& each) { return &each == &gone; });
}

}  // namespace waitpoint::posix
