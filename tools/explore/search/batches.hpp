// SPDX-License-Identifier: BSD-3-Clause
// Schedules of consecutive places that one process runs in turn, so that the explorer is woken once: as many as take
// little time together. A batch ends with the first that does not pass; what is left of it is another batch.
#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "fibers/explore/search/runner.hpp"

namespace waitpoint::tools {

using exploration::Batch;

class Batches {
 public:
  /// Of at most `most` schedules, whose numbers grow by `step`.
  explicit Batches(std::uint32_t most, std::uint64_t step = 1) : most_(most), step_(step) {}

  /// The number of schedules that the next batch may have.
  std::uint32_t size() const { return size_; }
  void start(const Batch& batch, double now_s);
  /// The batch at this place has ended with its first `count` schedules.
  void end(std::uint64_t place, std::uint32_t count, double now_s);
  /// Its process is lost. True if it had several schedules: each is left, as a batch of its own, to see which loses it.
  bool divide(std::uint64_t place);
  /// The first batch that is left, if it is before place `end`; it is not left any more.
  std::optional<Batch> take_left(std::uint64_t end);

 private:
  struct Running {
    Batch batch;
    double started_s;
  };
  void leave(const Batch& batch, std::uint32_t from, std::uint32_t count);

  std::uint32_t most_, size_ = 1;
  std::uint64_t step_;
  std::map<std::uint64_t, Running> running_;  // by place
  std::map<std::uint64_t, Batch> left_;
};

}  // namespace waitpoint::tools
