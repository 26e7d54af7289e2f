// SPDX-License-Identifier: BSD-3-Clause
// The paths of a robot in memory, for a picture: a run of any length needs bounded memory.
//
// A path is kept sample by sample up to its capacity, the samples of 27 minutes. Then the samples that do not form its
// line are left out: those closer to the rest than a tolerance, which begins at 5 mm and is doubled when the line
// itself does not fit. No omitted sample is farther from the line than twice the present tolerance.
#pragma once

#include <vector>

#include "modules/bridge/path.hpp"

namespace waitpoint::bridge {

class KeptPath {
 public:
  static constexpr std::size_t capacity = 16384;

  void add(const DatedPose& sample);
  /// At most `capacity`; the first and the newest are always among them.
  const std::vector<DatedPose>& samples() const { return samples_; }
  double tolerance_m() const { return tolerance_m_; }

 private:
  void thin(std::size_t first);

  std::vector<DatedPose> samples_;
  std::size_t thinned_ = 0;  // number of samples, from the first on, that were thinned
  double tolerance_m_ = 0.005;
};

class KeptPaths final : public PathSink {
 public:
  void add(PathKind kind, const DatedPose& sample) override { paths_[kind].add(sample); }
  const std::vector<DatedPose>& samples(PathKind kind) const { return paths_[kind].samples(); }

 private:
  PerPath<KeptPath> paths_;
};

}  // namespace waitpoint::bridge
