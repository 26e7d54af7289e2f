// SPDX-License-Identifier: BSD-3-Clause
// GenoM's descriptions of modules, with the C declarations in them.
#include <cstddef>
#include <cstdint>
#include <string>

#include "modules/description/parser.hpp"
#include "tests/fuzz/refusal.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string contents(reinterpret_cast<const char*>(data), size);
  waitpoint::fuzz::reads_or_refuses([&] {
    waitpoint::description::parse_description({"demo.gen", contents}, {}, [&](const std::string& path) {
      // A header that includes itself.
      return path == "demo.h" ? std::optional(contents) : std::nullopt;
    });
  });
  return 0;
}
