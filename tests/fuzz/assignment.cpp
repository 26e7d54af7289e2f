// SPDX-License-Identifier: BSD-3-Clause
// --set: one assignment per line, all to one document.
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>

#include "modules/scenario/yaml_override.hpp"
#include "tests/fuzz/refusal.hpp"

using namespace waitpoint;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const scenario::YamlNode shipped = scenario::parse_yaml(
      "{world: {step_ms: 10, shapes: [{name: crate, height_m: 1}, {name: desk}]}, robots: [{name: a}, 7], goals: [[1, "
      "2]]}",
      "scenario");
  std::istringstream lines(std::string(reinterpret_cast<const char*>(data), size));
  scenario::YamlNode document = shipped;
  constexpr int assignments_max = 16;
  std::string line;
  for (int i = 0; i < assignments_max && std::getline(lines, line); ++i)
    fuzz::reads_or_refuses([&] { assign(document, scenario::Assignment(line)); });
  scenario::fingerprint(document);
  return 0;
}
