// SPDX-License-Identifier: BSD-3-Clause
// Data that every rank produces and the first one writes to a file: events, samples of paths.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace waitpoint::run {

class Freight {
 public:
  virtual ~Freight() = default;
  /// This rank's data since the last call.
  virtual std::string load() = 0;
  /// On the first rank: the data of each rank, in the order of the ranks.
  virtual void unload(std::span<const std::string> loads) = 0;
};

}  // namespace waitpoint::run
