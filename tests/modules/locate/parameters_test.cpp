// SPDX-License-Identifier: BSD-3-Clause
// Values that localisation cannot work with are told at their setting.
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "modules/locate/locate.hpp"

namespace waitpoint::locate {
namespace {

std::string complaint(std::vector<Setting> set) {
  genom::Settings settings(std::move(set));
  try {
    read_parameters(settings);
  } catch (const BadInput& error) {
    return error.what();
  }
  return "";
}

TEST(LocateParameters, ValuesOutOfRangeAreToldWithTheirLine) {
  EXPECT_EQ(complaint({}), "");
  EXPECT_EQ(complaint({{"finding.view_turn_rad", "0.1", "s.yaml", 3}}), "");
  EXPECT_EQ(complaint({{"finding.view_turn_rad", "0", "s.yaml", 3}}),
            "s.yaml:3: expected 'finding.view_turn_rad' to be 0.01 or more, found '0'");
  EXPECT_EQ(complaint({{"tracking.lost_scans", "0", "s.yaml", 3}}),
            "s.yaml:3: expected 'tracking.lost_scans' to be 1 or more, found '0'");
  EXPECT_EQ(complaint({{"tracking.explained_min", "1.5", "s.yaml", 3}}),
            "s.yaml:3: expected 'tracking.explained_min' to be 1 or less, found '1.5'");
}

TEST(LocateParameters, TheNumbersOfViewsAreInOrder) {
  EXPECT_EQ(complaint({{"finding.views_min", "40", "s.yaml", 3}}),
            "s.yaml:3: expected 'finding.views_min' to be 30 or less, found '40'");
  EXPECT_EQ(complaint({{"finding.views_max", "4", "s.yaml", 3}}),
            "s.yaml:3: expected 'finding.views_max' to be 10 or more, found '4'");
  EXPECT_EQ(complaint({{"finding.views_min", "40", "s.yaml", 3}, {"finding.views_max", "50", "s.yaml", 4}}), "");
}

}  // namespace
}  // namespace waitpoint::locate
