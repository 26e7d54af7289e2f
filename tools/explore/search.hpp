// SPDX-License-Identifier: BSD-3-Clause
// Schedule after schedule of a target, several at once, each in a process of its own, until one fails or it is enough.
//
// Numbers are dealt out in their order. When one fails, those below it are waited for and those above are given up: so
// the failure that is told is the one of the lowest number, however many processes there are.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <unordered_set>

#include "tools/explore/children.hpp"
#include "tools/explore/depth_first.hpp"
#include "tools/explore/search_progress.hpp"
#include "tools/explore/target.hpp"

namespace waitpoint::tools {

/// One run of the target in a process of its own; nothing where a signal to this one came between.
std::optional<Finding> run_apart(Target& target, const Plan& plan, const Target::Request& request = {});

/// "00000000000000000017 wp1:0123456789abcdef failed: 2 collisions, expected 0": as wide as any number, so that text
/// sorts as numbers do.
std::string result_line(std::uint64_t number, const Finding& finding);

class Search {
 public:
  struct Failed {
    std::uint64_t number;
    Finding finding;
  };

  Search(Target& target, SearchProgress& progress);

  /// Tries the schedules that its options ask for. With `all`, failures do not end it.
  void run(bool all);

  std::uint64_t schedules() const { return schedules_; }
  std::uint64_t distinct() const { return digests_.size(); }
  std::uint64_t failures() const { return failures_; }
  bool interrupted() const { return interrupted_; }
  /// Of a strategy that tries all there are, once it has: what they are all of.
  const std::optional<std::string>& scope() const { return scope_; }
  const std::optional<Failed>& first() const { return first_; }
  /// With `all`: the lines of all, in their order.
  const std::map<std::uint64_t, std::string>& lines() const { return lines_; }

 private:
  bool may_start(bool all) const;
  void take(std::uint64_t number, Finding finding, bool all);
  void run_drawn(bool all);
  void run_depth_first(DepthFirst tree, bool all);

  Target& target_;
  SearchProgress& progress_;
  Children children_;
  std::uint64_t started_ = 0;
  std::uint64_t schedules_ = 0, failures_ = 0;
  std::unordered_set<std::uint64_t> digests_;
  std::optional<Failed> first_;
  std::map<std::uint64_t, std::string> lines_;
  bool interrupted_ = false;
  std::optional<std::string> scope_;
};

}  // namespace waitpoint::tools
