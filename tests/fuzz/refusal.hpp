// SPDX-License-Identifier: BSD-3-Clause
// A loader must read any input, or reject it by a BadInput of one line.
#pragma once

#include <cstdlib>
#include <string_view>

#include "core/error.hpp"

namespace waitpoint::fuzz {

template <class Loader>
void reads_or_refuses(const Loader& loader) {
  try {
    loader();
  } catch (const BadInput& bad) {
    const std::string_view line = bad.what();
    if (line.find('\n') != line.npos) std::abort();
  }
}

}  // namespace waitpoint::fuzz
