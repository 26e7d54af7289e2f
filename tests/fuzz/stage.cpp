// SPDX-License-Identifier: BSD-3-Clause
// Worlds of Stage.
#include <cstddef>
#include <cstdint>
#include <string>

#include "tests/fuzz/refusal.hpp"
#include "world/formats/stage.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string contents(reinterpret_cast<const char*>(data), size);
  waitpoint::fuzz::reads_or_refuses([&] {
    waitpoint::world::LeftOut left_out;
    waitpoint::world::parse_stage(contents, "stage", left_out);
    left_out.warnings();
  });
  return 0;
}
