// SPDX-License-Identifier: BSD-3-Clause
// Logs of sensors in all formats: what is read can be put into the order of play.
#include <cstddef>
#include <cstdint>
#include <string>

#include "modules/logs/log_file.hpp"
#include "modules/logs/playing_order.hpp"
#include "tests/fuzz/refusal.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string contents(reinterpret_cast<const char*>(data), size);
  waitpoint::fuzz::reads_or_refuses(
      [&] { waitpoint::logs::playing_order(waitpoint::logs::parse_log("log", contents, {})); });
  return 0;
}
