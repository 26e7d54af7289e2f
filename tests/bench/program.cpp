// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/program.hpp"

#include <fmt/format.h>

#include "core/error.hpp"

namespace waitpoint::bench {

int run_program(CLI::App& app, int argc, char** argv, const std::function<std::vector<Row>()>& measure) {
  std::string json;
  app.add_option("--json", json, "file for the rows");
  CLI11_PARSE(app, argc, argv);
  try {
    const std::vector<Row> rows = measure();
    if (!json.empty()) write_json(json, rows);
    return 0;
  } catch (const BadInput& error) {
    fmt::print(stderr, "{}: {}\n", std::filesystem::path(argv[0]).filename().string(), error.what());
    return 2;
  }
}

}  // namespace waitpoint::bench
