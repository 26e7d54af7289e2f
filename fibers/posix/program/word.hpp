// SPDX-License-Identifier: BSD-3-Clause
// The waitable of a primitive of four bytes, found by address since it has room for nothing but its value.
#pragma once

#include "fibers/posix/program/waitable.hpp"

namespace waitpoint::posix {

struct Word : Waitable {
  static constexpr Kind kind_of_all = Kind::word;
  explicit Word(const void* address) : Waitable(kind_of_all, "word", address) {}
};

inline Word& word_at(const void* address) { return waitable_at<Word>(address); }

}  // namespace waitpoint::posix
