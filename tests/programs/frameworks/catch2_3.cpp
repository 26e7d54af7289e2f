// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch_test_macros.hpp>

#include "tests/programs/frameworks/tests_of_threads.hpp"
