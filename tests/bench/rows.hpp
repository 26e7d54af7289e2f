// SPDX-License-Identifier: BSD-3-Clause
// Results of a benchmark, as rows printed in a table and written as JSON.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace waitpoint::bench {

/// One figure: of benchmark `bench`, in `case_name`, for subject `who`.
struct Row {
  std::string bench, case_name, who;
  double value = 0;
  std::string unit;
  std::optional<double> must = {};  ///< lower bound
};

/// A row of the table, with the ratio of the value to its bound; ends with a newline.
std::string table_row(const Row& row);

/// Writes a list of {bench, case, who, value, unit}, and `must` if set. BadInput if the file cannot be written.
void write_json(const std::filesystem::path& file, const std::vector<Row>& rows);

}  // namespace waitpoint::bench
