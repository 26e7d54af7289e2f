// SPDX-License-Identifier: BSD-3-Clause
#include "modules/ndd/regions.hpp"

#include <cmath>

namespace waitpoint::ndd {
namespace {

bool gap_between(const Sector& a, const Sector& b, double width_m) {
  if (a.occupied() != b.occupied()) return true;
  return a.occupied() && std::fabs(a.distance_m - b.distance_m) >= width_m;
}

}  // namespace

double Region::middle_rad() const {
  const double from_first = 0.5 * static_cast<double>(sectors - 1) * sector_width_rad;
  return exact::wrap_angle(Diagram::bisector_rad(first) + from_first);
}

void find_regions(const Diagram& diagram, double robot_width_m, Regions& regions) {
  regions.clear();
  int start = -1;  // the first sector after a gap
  for (int i = 0; i < sector_count && start < 0; ++i) {
    if (gap_between(diagram[i - 1], diagram[i], robot_width_m)) start = i;
  }
  if (start < 0) {
    if (!diagram[0].occupied()) regions.push_back({0, sector_count, true, true});
    return;
  }
  int first = start;
  for (int i = start; i < start + sector_count; ++i) {
    if (!gap_between(diagram[i], diagram[i + 1], robot_width_m)) continue;
    const Region region = {static_cast<int>(Diagram::wrap(first)), i - first + 1,
                           diagram[first].distance_m > diagram[first - 1].distance_m,
                           diagram[i].distance_m > diagram[i + 1].distance_m};
    if (region.opens_at_right || region.opens_at_left) regions.push_back(region);
    first = i + 1;
  }
}

}  // namespace waitpoint::ndd
