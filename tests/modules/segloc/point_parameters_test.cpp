// SPDX-License-Identifier: BSD-3-Clause
// Values that the map of points cannot work with are told at their setting.
#include "modules/segloc/point_parameters.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace waitpoint::segloc {
namespace {

std::string complaint(std::vector<Setting> set) {
  genom::Settings settings(std::move(set));
  try {
    read_point_parameters(settings);
  } catch (const BadInput& error) {
    return error.what();
  }
  return "";
}

TEST(PointParameters, ValuesOutOfRangeAreToldWithTheirLine) {
  EXPECT_EQ(complaint({}), "");
  EXPECT_EQ(complaint({{"points.cell_m", "0.1", "s.yaml", 3}}), "");
  EXPECT_EQ(complaint({{"points.submap_keys", "1", "s.yaml", 3}}),
            "s.yaml:3: expected 'points.submap_keys' to be 4 or more, found '1'");
  EXPECT_EQ(complaint({{"points.cell_m", "0", "s.yaml", 3}}),
            "s.yaml:3: expected 'points.cell_m' to be 0.01 or more, found '0'");
  EXPECT_EQ(complaint({{"points.rival_share", "1.5", "s.yaml", 3}}),
            "s.yaml:3: expected 'points.rival_share' to be 1 or less, found '1.5'");
  EXPECT_EQ(complaint({{"points.match_rad", "-1", "s.yaml", 3}}),
            "s.yaml:3: expected 'points.match_rad' to be 0.0001 or more, found '-1'");
}

TEST(PointParameters, TheLimitsOfTheSearchAreInOrder) {
  EXPECT_EQ(complaint({{"points.search_m_min", "9", "s.yaml", 3}}),
            "s.yaml:3: expected 'points.search_m_min' to be 5 or less, found '9'");
  EXPECT_EQ(complaint({{"points.search_m_max", "0.2", "s.yaml", 3}}),
            "s.yaml:3: expected 'points.search_m_max' to be 0.5 or more, found '0.2'");
  EXPECT_EQ(complaint({{"points.search_m_min", "9", "s.yaml", 3}, {"points.search_m_max", "12", "s.yaml", 4}}), "");
}

}  // namespace
}  // namespace waitpoint::segloc
