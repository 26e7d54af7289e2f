// SPDX-License-Identifier: BSD-3-Clause
// The result of one measuring process.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace waitpoint::bench {

struct Measured {
  enum class End { answered, declined, failed } end = End::failed;
  std::string why;                       ///< reason of a failure
  std::map<std::string, double> values;  ///< by name
  std::map<std::string, std::string> words;
};

/// Runs `program WORKLOAD TASKS BUDGET_MS [hooks]` for at most `limit_s` seconds.
Measured measure_once(const std::filesystem::path& program, const std::string& workload, int tasks, int budget_ms,
                      bool hooks, int limit_s);

/// Keeps the smaller time of both, and the greater of every other value.
void keep_best(Measured& best, const Measured& other);

}  // namespace waitpoint::bench
