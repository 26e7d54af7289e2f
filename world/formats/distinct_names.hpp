// SPDX-License-Identifier: BSD-3-Clause
// Makes names distinct.
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>

namespace waitpoint::world {

class DistinctNames {
 public:
  /// `name`, or if that is taken, `name` with the first free suffix of "_1", "_2", ...
  std::string take(const std::string& name) {
    std::string distinct = name;
    while (!names_.insert(distinct).second) distinct = name + "_" + std::to_string(++counts_[name]);
    return distinct;
  }

 private:
  std::set<std::string> names_;
  std::map<std::string, std::size_t> counts_;
};

}  // namespace waitpoint::world
