// SPDX-License-Identifier: BSD-3-Clause
// The program that a benchmark is: its command line, its rows, its errors.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "tests/bench/rows.hpp"

namespace waitpoint::bench {

/// Reads the command line by the options of `app` and --json, measures, and writes the rows where they are asked for.
/// Returns the exit status; BadInput is one line, and 2.
int run_program(CLI::App& app, int argc, char** argv, const std::function<std::vector<Row>()>& measure);

}  // namespace waitpoint::bench
