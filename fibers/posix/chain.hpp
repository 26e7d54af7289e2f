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

/// Takes `gone` out, if it is among them.
template <class Record>
void remove(Record*& first, const Record& gone) {
  Record** link = &first;
  while (*link != nullptr && *link != &gone) link = &(*link)->next;
  if (*link != nullptr) *link = gone.next;
}

}  // namespace waitpoint::posix
