// SPDX-License-Identifier: BSD-3-Clause
// Schedules from a fuzzer: its input says what is chosen, a byte for each choice, and it looks for the inputs that come
// to new code. For libFuzzer, whose whole program this is:
//
//   extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
//     static waitpoint::fuzz_target target([] { /* threads, mutexes, ...; waitpoint::check(...); */ });
//     return target.run(data, size);
//   }
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "fibers/explore/body.hpp"

namespace waitpoint {

class fuzz_target {
 public:
  explicit fuzz_target(std::function<void()> body);

  /// Runs the body once, by these bytes; what they leave open is the default order. A failure is told, and ends the
  /// process as fuzzers expect it: by abort(). Else 0.
  int run(const std::uint8_t* data, std::size_t size);

 private:
  exploration::Body body_;
};

}  // namespace waitpoint
