// SPDX-License-Identifier: BSD-3-Clause
// The two-sample test of Kolmogorov and Smirnov: are two samples of one distribution? (Press, Teukolsky, Vetterling,
// Flannery, "Numerical Recipes", ch. 14.3; Stephens 1970 for the correction of small samples.)
#pragma once

#include <cstddef>
#include <vector>

namespace waitpoint::tools {

struct TwoSamples {
  double distance = 0;     ///< greatest difference of the two empirical distribution functions
  double probability = 1;  ///< of such a distance or a greater one between samples of one distribution
  /// Cliff's delta, the size of the effect: the probability that a value of the second is greater than one of the
  /// first, less that it is smaller. From -1 to 1; 0: neither tends to be greater.
  double delta = 0;
};

/// Of samples that are not empty; their values need not be distinct.
TwoSamples compare_samples(std::vector<double> a, std::vector<double> b);

}  // namespace waitpoint::tools
