// SPDX-License-Identifier: BSD-3-Clause
// The tables of sensors' keys and readings in docs/sensors.md are those of the declarations.
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

template <class S>
std::string reading_row() {
  std::string name(S::key);
  if constexpr (requires { S::named; })
    name = "NAME";
  else if constexpr (world::HasSeveral<S>)
    name = S::device;
  std::string fields;
  S::Reading::fields([&](std::string_view field, auto, const auto&...) {
    fields += (fields.empty() ? "`" : ", `") + std::string(field) + "`";
  });
  return "| `" + name + ".reading` | " + fields + " | " +
         (world::HasCommand<S>  ? "`" + name + ".command`"
          : world::StartsOff<S> ? "`base.command`"
                                : "-") +
         " |\n";
}

TEST(SensorTables, AreThoseOfTheDeclarations) {
  const std::string page = file_contents((test::project_root() / "docs" / "sensors.md").string(), "a page", 1 << 20);
  const auto expect_table = [&](std::string_view of, const KeyTable& keys) {
    const std::string table = table_of(keys);
    EXPECT_NE(page.find(table), page.npos) << "docs/sensors.md lacks this table of " << of << ":\n" << table;
  };
  world::Sensors::for_each([&]<class S>() { expect_table(S::key, sensor_keys<S>().table()); });
  std::string readings = "| value | fields | switched by |\n|---|---|---|\n";
  world::Sensors::for_each([&]<class S>() { readings += reading_row<S>(); });
  EXPECT_NE(page.find(readings), page.npos) << "docs/sensors.md lacks this table of readings:\n" << readings;
  expect_table("the errors of gyro and accelerometers", keys_of<world::InertialErrors>().table());
}

}  // namespace
}  // namespace waitpoint::scenario
