// SPDX-License-Identifier: BSD-3-Clause
// What standard.hpp has, for tests.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <mutex>
#include <set>

#include "tools/dev/precompiled/standard.hpp"
