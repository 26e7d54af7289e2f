// SPDX-License-Identifier: BSD-3-Clause
// Explores a specimen as explore() does, without the analysis of a failure.
#pragma once

#include <optional>
#include <string>

#include "fibers/explore/body_watch.hpp"
#include "fibers/explore/play.hpp"

namespace waitpoint::zoo {

struct Found {
  std::uint64_t schedules;  ///< tried, including this one
  exploration::Finding failure;
};

class Search {
 public:
  explicit Search(void (*function)());

  /// The verdict of the default order.
  const exploration::RunVerdict& usual() const { return usual_; }
  /// The first failure among `most` schedules of `strategy`; nothing if there is none, or an exhaustive search ended.
  std::optional<Found> find(const std::string& strategy, std::uint64_t seed, std::uint64_t most);
  /// The number of failures among the first `count` schedules of `strategy`, which draws them.
  std::uint64_t failures(const std::string& strategy, std::uint64_t seed, std::uint64_t count);
  /// The run of that token.
  exploration::RunVerdict play(const exploration::Token& token) { return exploration::play(body_, token, profile_); }
  exploration::Body& body() { return body_; }

 private:
  exploration::Body body_;
  exploration::Profile profile_;
  exploration::RunVerdict usual_;
};

}  // namespace waitpoint::zoo
