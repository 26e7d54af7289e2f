// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/kernel/meter.hpp"

#include <time.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace waitpoint::bench {
namespace {

// The value of a line "NAME:  VALUE kB" of a file under /proc/self; 0 if missing.
std::int64_t kilobytes_of(const char* file, const char* name) {
  std::FILE* stream = std::fopen(file, "r");
  if (stream == nullptr) return 0;
  char line[256];
  long long value = 0;
  while (std::fgets(line, sizeof line, stream) != nullptr)
    if (std::strncmp(line, name, std::strlen(name)) == 0) value = std::atoll(line + std::strlen(name));
  std::fclose(stream);
  return value;
}

}  // namespace

std::atomic<std::uint64_t> counted = 0;

Request parse_request(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(stderr, "%s: started by the benchmark `kernel`, as: WORKLOAD TASKS BUDGET_MS [hooks]\n", argv[0]);
    std::exit(2);
  }
  Request request;
  request.workload = argv[1];
  request.tasks = std::atoi(argv[2]);
  request.budget_ms = std::atoi(argv[3]);
  request.hooks = argc > 4;
  return request;
}

std::int64_t clock_ns(Clock clock) {
  timespec now{};
  clock_gettime(clock == Clock::processor ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_MONOTONIC, &now);
  return now.tv_sec * std::int64_t{1'000'000'000} + now.tv_nsec;
}

void answer(const char* name, double value) { std::printf("%s %.17g\n", name, value); }
void answer(const char* name, const char* value) { std::printf("%s %s\n", name, value); }

void leave() {
  std::fflush(stdout);
  _exit(0);
}

void decline() { _exit(declined); }

std::int64_t resident_bytes() { return 1024 * kilobytes_of("/proc/self/smaps_rollup", "Rss:"); }
std::int64_t page_table_bytes() { return 1024 * kilobytes_of("/proc/self/status", "VmPTE:"); }

}  // namespace waitpoint::bench
