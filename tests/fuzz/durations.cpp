// SPDX-License-Identifier: BSD-3-Clause
// Records of durations: what is read is written as it was.
#include <cstddef>
#include <cstdint>
#include <string>

#include "core/error.hpp"
#include "fibers/sync/duration_record.hpp"
#include "tests/fuzz/refusal.hpp"

using namespace waitpoint;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string contents(reinterpret_cast<const char*>(data), size);
  fuzz::reads_or_refuses([&] {
    const std::string written = to_text(parse_duration_record("durations", contents));
    WAITPOINT_CHECK(to_text(parse_duration_record("again", written)) == written, "a record changes when it is read");
  });
  return 0;
}
