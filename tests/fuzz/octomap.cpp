// SPDX-License-Identifier: BSD-3-Clause
// OctoMap's octrees.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "tests/fuzz/refusal.hpp"
#include "world/formats/octree.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view contents(reinterpret_cast<const char*>(data), size);
  waitpoint::fuzz::reads_or_refuses([&] { waitpoint::world::parse_octree(contents, "octree"); });
  return 0;
}
