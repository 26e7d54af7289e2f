// SPDX-License-Identifier: BSD-3-Clause
#include "core/error.hpp"

#include <cstdio>
#include <cstdlib>

#include "core/printable_line.hpp"

/// Called before the report, where a kernel is linked: what ends the process has begun (kernel/process_end.hpp).
extern "C" void waitpoint_begin_death() __attribute__((weak));

namespace waitpoint {

BadInput::BadInput(const std::string& file, int line, const std::string& message)
    : std::runtime_error(printable_line(file + ":" + (line > 0 ? std::to_string(line) + ": " : " ")) +
                         printable_message(message)),
      file_(file),
      line_(line) {}

BadInput::BadInput(const std::string& where, const std::string& message) : BadInput(where, 0, message) {}

BadInput::BadInput(const BadInput& other, const std::string& note)
    : std::runtime_error(other.what() + printable_line(note)), file_(other.file_), line_(other.line_) {}

BadInput BadInput::with_note(const std::string& note) const { return {*this, note}; }

void bug(const char* file, int line, const char* condition, const char* message) {
  if (waitpoint_begin_death != nullptr) waitpoint_begin_death();
  std::fflush(stdout);
  std::fprintf(stderr, "waitpoint: bug: %s (%s) at %s:%d\n", message, condition, file, line);
  if (waitpoint_describe_run != nullptr) waitpoint_describe_run();
  std::fflush(stderr);
  std::abort();
}

void misuse(const char* message) {
  if (waitpoint_begin_death != nullptr) waitpoint_begin_death();
  std::fflush(stdout);
  std::fprintf(stderr, "waitpoint: misuse: %s\n", message);
  if (waitpoint_describe_run != nullptr) waitpoint_describe_run();
  if (waitpoint_describe_caller != nullptr) waitpoint_describe_caller();
  std::fflush(stderr);
  std::abort();
}

}  // namespace waitpoint
