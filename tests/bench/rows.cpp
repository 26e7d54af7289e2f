// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/rows.hpp"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "core/error.hpp"

namespace waitpoint::bench {

std::string table_row(const Row& row) {
  const int decimals = row.value < 10 ? 2 : 1;
  std::string line = fmt::format("{:<12} {:<30} {:<12} {:>10.{}f} {}", row.bench, row.case_name, row.who, row.value,
                                 decimals, row.unit);
  if (row.must) line += fmt::format("   {:.2f} of the {} that it must be", row.value / *row.must, *row.must);
  return line + "\n";
}

void write_json(const std::filesystem::path& file, const std::vector<Row>& rows) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Row& row : rows) {
    list.push_back(
        {{"bench", row.bench}, {"case", row.case_name}, {"who", row.who}, {"value", row.value}, {"unit", row.unit}});
    if (row.must) list.back()["must"] = *row.must;
  }
  std::ofstream stream(file);
  stream << list.dump(1) << '\n';
  if (!stream.flush()) throw BadInput(file.string(), 0, "cannot be written");
}

}  // namespace waitpoint::bench
