// SPDX-License-Identifier: BSD-3-Clause
#include "modules/bridge/kept_paths.hpp"

#include <algorithm>

#include "core/polyline.hpp"

namespace waitpoint::bridge {

void KeptPath::add(const DatedPose& sample) {
  samples_.push_back(sample);
  if (samples_.size() < capacity) return;
  // Thinning the old samples again at the same tolerance would add up their errors.
  thin(std::max<std::size_t>(thinned_, 1) - 1);
  while (samples_.size() > capacity / 2) {
    tolerance_m_ *= 2;
    thin(0);
  }
  thinned_ = samples_.size();
}

// Thins the samples from `first` on.
void KeptPath::thin(std::size_t first) {
  std::vector<Point> line;
  for (std::size_t i = first; i < samples_.size(); ++i) line.push_back(samples_[i].pose.position());
  std::size_t end = first;
  for (const std::size_t i : simplified(line, tolerance_m_)) samples_[end++] = samples_[first + i];
  samples_.resize(end);
}

}  // namespace waitpoint::bridge
