// SPDX-License-Identifier: BSD-3-Clause
// The faults of a peer by kind: the first of each kind of a connection is told, and all are counted.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace waitpoint::outside {

class FaultCounts {
 public:
  /// True for the first one of its kind.
  bool add(const std::string& kind) { return ++counts_[kind] == 1; }

  /// ", 1 from the past, 3 malformed"; empty without faults.
  std::string text() const {
    std::string text;
    for (const auto& [kind, count] : counts_) text += ", " + std::to_string(count) + " " + kind;
    return text;
  }

 private:
  std::map<std::string, std::uint64_t> counts_;
};

}  // namespace waitpoint::outside
