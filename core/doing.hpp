// SPDX-License-Identifier: BSD-3-Clause
// Activities of a thread outside of tasks, for the report of its death: "constructing module ndd of robot rackham".
#pragma once

#include <cstdint>

namespace waitpoint {

class Doing {
 public:
  /// In force until the object's end, unless an inner one is; the text must outlive it.
  explicit Doing(const char* text);
  ~Doing();
  Doing(const Doing&) = delete;
  Doing& operator=(const Doing&) = delete;

  /// The innermost text of this thread; null if there is none. Async-signal-safe.
  static const char* present();
  /// The number of texts so far, of all threads.
  static std::uint64_t count();

 private:
  const char* outer_;
};

}  // namespace waitpoint
