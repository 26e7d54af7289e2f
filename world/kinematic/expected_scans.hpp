// SPDX-License-Identifier: BSD-3-Clause
// Scans announced for the next step, and their readings. They are made together, neighbouring bodies in sequence, so
// that their surroundings are fetched from memory once and not for each scan.
//
//   expect       before the step: adds an entry to the coming list
//   begin        after the step: the coming list is to be made, and a new one begins
//   make         makes a body's entries; their ranges are adjacent in one array
//   find         copies a scan
//
// A scan has the same readings either way. A scan that was not announced with the same arguments is not found.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/error.hpp"
#include "world/world.hpp"

namespace waitpoint::world {

/// One scan of a laser as it is measured, counter-clockwise, in the device's frame. Reused between scans, it allocates
/// only once.
struct LaserScan {
  double first_angle_rad = 0, angle_step_rad = 0;
  double range_max_m = 0;       ///< the reading of a beam without echo
  std::vector<double> range_m;  ///< one per beam, measured: with noise, quantised
};

class ExpectedScans {
 public:
  struct Entry {
    std::uint32_t body, laser;
    std::uint64_t number;
    std::uint32_t next_of_body;
    std::uint32_t first_range = 0, ranges = 0;
    double first_angle_rad = 0, angle_step_rad = 0, range_max_m = 0;
  };

  /// Clears both lists.
  void restart(std::size_t bodies);
  /// Announces a scan, each at most once per step.
  void expect(std::uint32_t body, std::uint32_t laser, std::uint64_t number);

  /// Discards the scans made, and takes the next list as the one to be made. False if it is empty.
  bool begin();
  /// Calls make(entry, scan) for each of the body's entries, and keeps the scan that it fills in.
  template <class Make>
  void make(std::uint32_t body, Make make);
  /// Invalidates the scans made.
  void forget() { valid_ = false; }

  /// Copies a scan; false if it was not made, or is no longer valid.
  bool find(std::uint32_t body, std::uint32_t laser, std::uint64_t number, LaserScan& out) const;

 private:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  /// Entries, and per body the head of the list of its own, the last one first.
  struct List {
    std::vector<Entry> entries;
    std::vector<std::uint32_t> of_body;

    void clear();
  };

  List next_, made_;
  bool valid_ = false;
  std::vector<double> ranges_m_;  // of all scans made
  LaserScan scan_;                // scratch space of one call, kept so that it allocates nothing
};

template <class Make>
void ExpectedScans::make(std::uint32_t body, Make make) {
  WAITPOINT_CHECK(body < made_.of_body.size(), "scans are made of a body that does not exist");
  for (std::uint32_t at = made_.of_body[body]; at != none; at = made_.entries[at].next_of_body) {
    Entry& entry = made_.entries[at];
    WAITPOINT_FAST_CHECK(entry.body == body, "a body's list has a scan of another");
    make(entry, scan_);
    WAITPOINT_CHECK(ranges_m_.size() + scan_.range_m.size() <= none,
                    "the ranges of a step's scans exceed 32-bit indices");
    entry.first_range = static_cast<std::uint32_t>(ranges_m_.size());
    entry.ranges = static_cast<std::uint32_t>(scan_.range_m.size());
    entry.first_angle_rad = scan_.first_angle_rad;
    entry.angle_step_rad = scan_.angle_step_rad;
    entry.range_max_m = scan_.range_max_m;
    ranges_m_.insert(ranges_m_.end(), scan_.range_m.begin(), scan_.range_m.end());
  }
}

}  // namespace waitpoint::world
