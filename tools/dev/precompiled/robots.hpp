// SPDX-License-Identifier: BSD-3-Clause
// What standard.hpp has, for the libraries that format text.
#include <fmt/format.h>

#include <filesystem>

#include "tools/dev/precompiled/standard.hpp"
