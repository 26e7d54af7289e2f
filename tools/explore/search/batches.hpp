// SPDX-License-Identifier: BSD-3-Clause
// Schedules of consecutive places that one process runs in turn, so that the explorer is woken once: as many as take
// little time together. A batch ends with the first that does not pass; what is left of it is another batch.
#pragma once

#include <cstdint>
#include <map>
#include <optional>

namespace waitpoint::tools {

class Batches {
 public:
  struct Batch {
    std::uint64_t place;  ///< of its first schedule
    std::uint32_t count;
  };

  /// Of at most `most` schedules.
  explicit Batches(std::uint32_t most) : most_(most) {}

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
    std::uint32_t count;
    double started_s;
  };

  std::uint32_t most_, size_ = 1;
  std::map<std::uint64_t, Running> running_;     // by place
  std::map<std::uint64_t, std::uint32_t> left_;  // the counts by place
};

}  // namespace waitpoint::tools
