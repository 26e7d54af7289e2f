// SPDX-License-Identifier: BSD-3-Clause
// The main function of programs linked with -Wl,--wrap=main: the program's own one is the first task of a run. With
// WAITPOINT_STRATEGY, _ITERATIONS, _TIME_LIMIT or _REPLAY in the environment it is explored: run again and again, its
// static variables being what the last run left. A status other than 0 is then a failure.
#include <cstdio>
#include <cstdlib>
#include <iostream>

#include "core/error.hpp"
#include "fibers/explore/explore.hpp"
#include "fibers/sync/simulation.hpp"
#include "fibers/sync/thread.hpp"

// The names that the linker gives them.
extern "C" {
int __real_main(int argc, char** argv, char** environment);  // NOLINT(bugprone-reserved-identifier)
int __wrap_main(int argc, char** argv, char** environment);  // NOLINT(bugprone-reserved-identifier)
}

namespace {

bool is_to_be_explored() {
  for (const char* name : {"WAITPOINT_STRATEGY", "WAITPOINT_ITERATIONS", "WAITPOINT_TIME_LIMIT", "WAITPOINT_REPLAY"})
    if (std::getenv(name) != nullptr) return true;
  return false;
}

// Prints a report of a failed run, behind the program's output.
template <class Report>
int status_of(const Report& report, int status) {
  std::fflush(stdout);
  if (report.passed) return status;
  std::cerr << report << '\n';
  return 1;
}

}  // namespace

int __wrap_main(int argc, char** argv, char** environment) {
  int status = 0;
  // In a task of its own, for the stack of a program's first thread.
  const auto body = [&] {
    const waitpoint::thread_attributes attributes{.name = "tMain", .stack = waitpoint::kernel::StackSize::program};
    waitpoint::thread(attributes, [&] { status = __real_main(argc, argv, environment); }).join();
  };
  if (is_to_be_explored())
    return status_of(waitpoint::explore([&] {
                       body();
                       waitpoint::check(status == 0, "main() returned a status other than 0");
                     }),
                     0);
  try {
    return status_of(waitpoint::simulate(body), status);
  } catch (const waitpoint::BadInput& input) {
    std::cerr << input.what() << '\n';
    return 2;
  }
}
