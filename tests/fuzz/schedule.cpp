// SPDX-License-Identifier: BSD-3-Clause
// Schedules of scenarios as files: what is read is written as it was.
#include <cstddef>
#include <cstdint>
#include <string>

#include "core/error.hpp"
#include "tests/fuzz/input_folder.hpp"
#include "tests/fuzz/refusal.hpp"
#include "tools/explore/replay/schedule_file.hpp"

using namespace waitpoint;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::InputFolder folder;
  const std::filesystem::path file = folder.file("schedule", std::string(reinterpret_cast<const char*>(data), size));
  fuzz::reads_or_refuses([&] {
    const std::string written = to_text(tools::read_schedule(file));
    WAITPOINT_CHECK(to_text(tools::read_schedule(folder.file("written", written))) == written,
                    "a schedule changes when it is read");
  });
  return 0;
}
