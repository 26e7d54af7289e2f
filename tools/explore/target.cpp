// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/target.hpp"

namespace waitpoint::tools {

bool needs_profile(const std::string& strategy) {
  const std::string kind = strategy.substr(0, strategy.find(':'));
  return kind != "random" && kind != "pos" && kind != "fifo";
}

}  // namespace waitpoint::tools
