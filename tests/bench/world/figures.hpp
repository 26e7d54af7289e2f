// SPDX-License-Identifier: BSD-3-Clause
// Single figures with their own bounds: lines of the table, and rows.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/bench/rows.hpp"

namespace waitpoint::bench {

/// The bound of a figure: a minimum or a maximum.
struct Limit {
  double value;
  bool at_most = false;

  bool met_by(double figure) const { return at_most ? figure <= value : figure >= value; }
};

struct Figure {
  std::string case_name, who;
  double value = 0;
  std::string unit;
  std::optional<double> ratio = {};          ///< to the subject named in the case
  std::optional<Limit> must = {}, aim = {};  ///< of the ratio, or of the value without a ratio
};

class Figures {
 public:
  /// Prints it as a line of the table.
  void add(const Figure& figure);

  const std::vector<Row>& rows() const { return rows_; }
  /// The number of musts or aims, and of those met.
  struct Count {
    int all = 0, met = 0;
  };
  const Count& musts() const { return musts_; }
  const Count& aims() const { return aims_; }

 private:
  static std::string judge(const std::optional<Limit>& limit, double figure, Count& count);

  std::vector<Row> rows_;
  Count musts_, aims_;
};

}  // namespace waitpoint::bench
