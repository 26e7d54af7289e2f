// SPDX-License-Identifier: BSD-3-Clause
// Scans of a real SICK LMS in a real building, one beam a degree.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

#include "core/exact_math.hpp"
#include "modules/sick/segment_extraction.hpp"
#include "tests/project.hpp"

namespace waitpoint::sick {
namespace {

// Reads the ranges of a CARMEN line "FLASER n r1 .. rn x y theta ..."; false for other lines.
bool read_flaser(const char* line, posters::LaserReading& scan) {
  if (std::string_view(line).substr(0, 7) != "FLASER ") return false;
  char* at = nullptr;
  const auto beams = static_cast<std::uint32_t>(std::strtoul(line + 7, &at, 10));
  if (beams < 2 || beams > world::Lasers::count_max) return false;
  scan.range_m.resize(beams);
  for (std::uint32_t i = 0; i < beams; ++i) scan.range_m[i] = std::strtof(at, &at);
  scan.angle_step_rad = exact::pi / 180;
  scan.first_angle_rad = -0.5 * exact::pi;
  scan.range_max_m = 50;
  ++scan.number;
  return true;
}

TEST(IntelLog, MostScansHavePlausibleSegments) {
  const auto folder = test::data_folder();
  if (!folder) GTEST_SKIP() << "no data folder (WAITPOINT_DATA or ../shared/data)";
  const std::string command = "gzip -dc '" + *folder + "/logs/intel_lab.clf.gz' 2>/dev/null";
  std::FILE* log = popen(command.c_str(), "r");
  ASSERT_NE(log, nullptr);
  const auto echoes = std::make_unique<posters::Echoes>();
  const auto segments = std::make_unique<posters::Segments>();
  SegmentExtraction extraction({});
  std::string line(1 << 15, '\0');
  int scans = 0, with_two = 0, right_angles = 0, pairs = 0;
  double sum = 0;
  while (std::fgets(line.data(), static_cast<int>(line.size()), log) != nullptr) {
    if (!read_flaser(line.c_str(), echoes->scan)) continue;
    extraction.extract(*echoes, *segments);
    ++scans;
    const auto& items = segments->items;
    sum += static_cast<double>(items.size());
    if (items.size() >= 2) ++with_two;
    for (std::size_t i = 0; i < items.size(); ++i) {
      const auto& s = items[i];
      EXPECT_GE(s.points, 6u);
      EXPECT_GE(length(s.end - s.start), 0.4);
      EXPECT_LT(length(s.end - s.start), 40);
      const auto [aa, ad, dd] = s.covariance;
      EXPECT_GT(aa, 0);
      EXPECT_GT(aa * dd - ad * ad, 0);
      // A building's walls stand square to each other.
      for (std::size_t j = 0; j < i; ++j) {
        if (length(s.end - s.start) < 1 || length(items[j].end - items[j].start) < 1) continue;
        const double off_square = std::fabs(exact::sin(2.0 * (s.normal_rad - items[j].normal_rad)));
        ++pairs;
        if (off_square < exact::sin(2.0 * 0.05)) ++right_angles;
      }
    }
  }
  pclose(log);
  std::printf("[ measured ] %d scans, %.1f segments each, two or more in %.0f %%; %.0f %% of the pairs are square\n",
              scans, sum / scans, 100.0 * with_two / scans, 100.0 * right_angles / pairs);
  EXPECT_GT(scans, 8000);
  EXPECT_GT(with_two, 0.8 * scans);
  EXPECT_GT(right_angles, 0.6 * pairs);
}

}  // namespace
}  // namespace waitpoint::sick
