// SPDX-License-Identifier: BSD-3-Clause
// The tables of sensors' keys in docs/sensors.md are those of the declarations.
#include <gtest/gtest.h>

#include <regex>

#include "core/file_contents.hpp"
#include "modules/scenario/sensor_reader.hpp"
#include "tests/project.hpp"

namespace waitpoint::scenario {
namespace {

/// 10 in the place of 10.0.
std::string text_of(const Json& value) { return std::regex_replace(value.dump(), std::regex("\\.0\\b"), ""); }

std::string table_of(const KeyTable& keys) {
  std::string table = "| key | meaning | default |\n|---|---|---|\n";
  for (const KeyTable::Row& row : keys.rows())
    table += "| `" + row.name + "` | " + row.meaning + " | " +
             (row.otherwise.is_null() ? std::string("-") : text_of(row.otherwise)) + " |\n";
  return table;
}

TEST(SensorTables, AreThoseOfTheDeclarations) {
  const std::string page = file_contents((test::project_root() / "docs" / "sensors.md").string(), "a page", 1 << 20);
  const auto expect_table = [&](std::string_view of, const KeyTable& keys) {
    const std::string table = table_of(keys);
    EXPECT_NE(page.find(table), page.npos) << "docs/sensors.md lacks this table of " << of << ":\n" << table;
  };
  world::Sensors::for_each([&]<class S>() { expect_table(S::key, sensor_keys<S>().table()); });
  expect_table("the errors of gyro and accelerometers", keys_of<world::InertialErrors>().table());
}

}  // namespace
}  // namespace waitpoint::scenario
