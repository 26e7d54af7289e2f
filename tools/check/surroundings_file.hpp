// SPDX-License-Identifier: BSD-3-Clause
// The shared object of surroundings.cpp, as bytes: so that a program needs no file beside it to check itself.
#pragma once

#include <span>

namespace waitpoint::tools {

std::span<const unsigned char> surroundings_file();

}  // namespace waitpoint::tools
