// SPDX-License-Identifier: BSD-3-Clause
// Replay tokens: what is read is written as a token that is equal.
#include <cstddef>
#include <cstdint>
#include <string>

#include "core/error.hpp"
#include "fibers/explore/schedules/token.hpp"
#include "tests/fuzz/refusal.hpp"

using namespace waitpoint;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  fuzz::reads_or_refuses([&] {
    const exploration::Token token = exploration::read_token(text);
    WAITPOINT_CHECK(exploration::read_token(to_text(token)) == token, "a token changes when it is written");
  });
  return 0;
}
