// SPDX-License-Identifier: BSD-3-Clause
// Schedules from a fuzzer: each byte of the input makes a choice, and the fuzzer searches for inputs that reach new
// code. A complete program for libFuzzer:
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

  /// Runs the body once by these bytes, then in the default order. A failure is printed, and ends the process by
  /// abort(), as fuzzers expect. Else returns 0.
  int run(const std::uint8_t* data, std::size_t size);

 private:
  exploration::Body body_;
};

}  // namespace waitpoint
