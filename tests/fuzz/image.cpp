// SPDX-License-Identifier: BSD-3-Clause
// PGM and PNG.
#include <cstddef>
#include <cstdint>
#include <string>

#include "tests/fuzz/refusal.hpp"
#include "world/formats/image_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string contents(reinterpret_cast<const char*>(data), size);
  waitpoint::fuzz::reads_or_refuses([&] { waitpoint::world::parse_grey_image(contents, "image"); });
  return 0;
}
