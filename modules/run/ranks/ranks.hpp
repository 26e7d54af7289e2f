// SPDX-License-Identifier: BSD-3-Clause
// The ranks of a run, its processes, as one of them sees them. The first one, rank 0, leads: its user talks to it.
#pragma once

#include <functional>
#include <string>
#include <utility>

#include "core/time.hpp"
#include "modules/run/ranks/archive.hpp"
#include "modules/run/ranks/placement.hpp"
#include "modules/run/ranks/transport.hpp"

namespace waitpoint::run {

class Ranks {
 public:
  /// Called about ten times a second while others are waited for, with the seconds so far of this wait and the run's
  /// place; may throw.
  using Waiting = std::function<void(double seconds, const std::string& where)>;

  /// The transport must outlive this.
  Ranks(Transport& transport, Waiting waiting) : transport_(transport), waiting_(std::move(waiting)) {}

  void place(Placement placement) { placement_ = std::move(placement); }

  const Placement& placement() const { return placement_; }
  int rank() const { return transport_.rank(); }
  int count() const { return transport_.ranks(); }
  bool leads() const { return rank() == 0; }
  /// The run's place, for reports: "at the start", or "in window 12, at 0.110000000 s".
  void set_place(std::function<std::string()> place) { place_ = std::move(place); }

  // Collective: every rank calls them in the same order.

  /// The values of all ranks, in their order.
  template <class T>
  std::vector<T> gather(const T& own) {
    Packing packing;
    packing(own);
    std::vector<T> all;
    for (const std::string_view bytes : gather_bytes(packing.bytes())) {
      Unpacking unpacking(bytes);
      unpacking(all.emplace_back());
    }
    return all;
  }
  /// The first rank's value, on all.
  template <class T>
  T from_leader(const T& own) {
    Packing packing;
    if (leads()) packing(own);
    Unpacking unpacking(gather_bytes(packing.bytes()).front());
    T value;
    unpacking(value);
    return value;
  }
  /// Calls `act` on every rank. If it throws on some, the exception of the first of these is thrown on all: BadInput,
  /// or std::runtime_error for any other.
  void act_together(const std::function<void()>& act);
  /// Throws BadInput unless `value` is the same on all ranks: "expected the same WHAT on all ranks, ...".
  void check_same(const char* what, const std::string& value);

 private:
  const std::vector<std::string_view>& gather_bytes(std::string_view own);

  Transport& transport_;
  Placement placement_;
  Waiting waiting_;
  std::function<std::string()> place_ = [] { return "at the start"; };
};

}  // namespace waitpoint::run
