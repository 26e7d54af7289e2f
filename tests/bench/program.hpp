// SPDX-License-Identifier: BSD-3-Clause
// The main program of a benchmark: its command line, rows, errors.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "tests/bench/rows.hpp"

namespace waitpoint::bench {

/// Parses the options of `app` and --json, measures, and writes the rows if requested. Returns the exit status;
/// BadInput prints one line and returns 2.
int run_program(CLI::App& app, int argc, char** argv, const std::function<std::vector<Row>()>& measure);

}  // namespace waitpoint::bench
