// SPDX-License-Identifier: BSD-3-Clause
// This library's own `new`: of the record's arena, or of the family's memory.
#pragma once

namespace waitpoint::posix {

/// While one lives, `new` takes memory that the family's processes and the one that watches them share.
class NewInFamily {
 public:
  NewInFamily();
  ~NewInFamily();
  NewInFamily(const NewInFamily&) = delete;
  NewInFamily& operator=(const NewInFamily&) = delete;
};

}  // namespace waitpoint::posix
