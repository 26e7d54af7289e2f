// SPDX-License-Identifier: BSD-3-Clause
// The preloaded object of surroundings/ as bytes: a program can check itself without further files.
#pragma once

#include <span>

namespace waitpoint::tools {

std::span<const unsigned char> surroundings_file();

}  // namespace waitpoint::tools
