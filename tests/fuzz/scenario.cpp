// SPDX-License-Identifier: BSD-3-Clause
// The YAML of scenarios, floors and robot types.
#include <cstddef>
#include <cstdint>
#include <string>

#include "modules/scenario/yaml_tree.hpp"
#include "tests/fuzz/refusal.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string contents(reinterpret_cast<const char*>(data), size);
  waitpoint::fuzz::reads_or_refuses([&] { waitpoint::scenario::parse_yaml(contents, "scenario"); });
  return 0;
}
