// SPDX-License-Identifier: BSD-3-Clause
// The YAML of a map_server's map; its image is mostly missing.
#include <cstddef>
#include <cstdint>
#include <string>

#include "tests/fuzz/refusal.hpp"
#include "world/formats/map_server.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string contents(reinterpret_cast<const char*>(data), size);
  waitpoint::fuzz::reads_or_refuses([&] {
    waitpoint::world::LeftOut left_out;
    waitpoint::world::parse_map_server_map(contents, "map_server", left_out);
  });
  return 0;
}
