// SPDX-License-Identifier: BSD-3-Clause
#define CATCH_CONFIG_MAIN
#define CATCH_CONFIG_CONSOLE_WIDTH 1000  // the replay line of a report stays one line
#include <catch2/catch.hpp>

#include "tests/programs/frameworks/tests_of_threads.hpp"
