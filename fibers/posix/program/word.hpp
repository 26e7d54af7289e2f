// SPDX-License-Identifier: BSD-3-Clause
// Who waits at an address: for primitives of four bytes, which have no room for more than their value.
#pragma once

#include "fibers/posix/program/waitable.hpp"

namespace waitpoint::posix {

struct Word : Waitable {
  static constexpr Kind kind_of_all = Kind::word;
  explicit Word(const void* address) : Waitable(kind_of_all, "word", address) {}
};

inline Word& word_at(const void* address) { return waitable_at<Word>(address); }

}  // namespace waitpoint::posix
