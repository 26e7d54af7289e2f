// SPDX-License-Identifier: BSD-3-Clause
// The outcomes of a search's schedules, a line each, in the order of their numbers. They are written as they come: the
// file can be read while the search goes on.
//
//   # waitpoint results 1: scenario 0123456789abcdef, strategy portfolio, seed 1
//   00000000000000000017 wp1:0123456789abcdef failed: 2 collisions, expected 0
//
// Zero-padded, so that sorting text sorts by number. Every shard writes the same head line, so that merged and sorted
// files have it once.
#pragma once

#include <cstdint>
#include <filesystem>

#include "tools/explore/runs/finding.hpp"
#include "tools/explore/runs/target.hpp"
#include "tools/output/output_file.hpp"

namespace waitpoint::tools {

class ResultsFile {
 public:
  explicit ResultsFile(const std::filesystem::path& path) : file_(path) {}

  void begin(const ProcessTarget& target);
  void take(std::uint64_t number, const Finding& finding);
  void commit() { file_.commit(); }

 private:
  OutputFile file_;
};

}  // namespace waitpoint::tools
