// SPDX-License-Identifier: BSD-3-Clause
// What every rank produces while it runs and the first one writes to a file: events, samples of paths.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace waitpoint::run {

class Freight {
 public:
  virtual ~Freight() = default;
  /// What this rank has produced since the last call.
  virtual std::string load() = 0;
  /// On the first rank: what each rank has, in the order of the ranks.
  virtual void unload(std::span<const std::string> loads) = 0;
};

}  // namespace waitpoint::run
