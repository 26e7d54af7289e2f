// SPDX-License-Identifier: BSD-3-Clause
// The numbers of posters over time: every field that is a number, but not those of lists.
#pragma once

#include <string>
#include <vector>

#include "modules/genom/poster.hpp"
#include "modules/run/experiment.hpp"

namespace waitpoint::tools::view {

/// The paths of the numbers of a value of this structure: "position.pose.x".
std::vector<std::string> number_paths(const FieldShape& shape);

class PosterPlots {
 public:
  /// Of the posters of all robots; the experiment must outlive this.
  explicit PosterPlots(const run::Experiment& experiment);

  /// The number of values that take() takes.
  std::size_t size() const { return size_; }
  /// The present values; between events.
  void take(Time now);
  /// `"plot_times":[...],"plots":[...]`.
  std::string text() const;

 private:
  struct OfPoster {
    std::size_t robot;
    const genom::PosterBase* poster;
    std::vector<FieldReading> readings;
    std::vector<std::vector<float>> values;  // by reading; NaN: none
  };

  std::vector<OfPoster> posters_;
  std::vector<std::int64_t> times_;
  std::size_t size_ = 0;
};

}  // namespace waitpoint::tools::view
