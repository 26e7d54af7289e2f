// SPDX-License-Identifier: BSD-3-Clause
// What a benchmark found, as rows that are printed as a table and written as JSON.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace waitpoint::bench {

/// One figure: of benchmark `bench`, in `case_name`, of `who`.
struct Row {
  std::string bench, case_name, who;
  double value = 0;
  std::string unit;
  std::optional<double> must = {};  ///< what it has to be at least
};

/// A row of the table, with the ratio of value and what it must be; ends with a newline.
std::string table_row(const Row& row);

/// Writes a list of {bench, case, who, value, unit}, and `must` where there is one. BadInput where it cannot be
/// written.
void write_json(const std::filesystem::path& file, const std::vector<Row>& rows);

}  // namespace waitpoint::bench
