// SPDX-License-Identifier: BSD-3-Clause
// Meshes in STL and OBJ. (Files for Assimp are not fuzzed.)
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "tests/fuzz/refusal.hpp"
#include "world/formats/obj.hpp"
#include "world/formats/stl.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view contents(reinterpret_cast<const char*>(data), size);
  for (const auto parse : {&waitpoint::world::parse_stl, &waitpoint::world::parse_obj}) {
    waitpoint::fuzz::reads_or_refuses([&] {
      waitpoint::world::LeftOut left_out;
      parse(contents, "mesh", left_out);
      left_out.warnings();
    });
  }
  return 0;
}
