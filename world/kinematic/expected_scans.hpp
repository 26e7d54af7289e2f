// SPDX-License-Identifier: BSD-3-Clause
// Scans that somebody said he will ask for after the next step, and then what they read: made together, those of
// neighbours one after the other, what stands and goes about them is fetched from memory once and not for each alone.
//
//   expect       before the step: a list, one entry a scan
//   begin        the step is done: the list is what is to be made; a new one begins
//   make         each entry, in whatever order: its ranges go side by side into one array
//   find         whoever asks gets a copy
//
// A scan reads the same however it is made. One that was not expected, or not as it then is asked for, is not found.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "world/world.hpp"

namespace waitpoint::world {

class ExpectedScans {
 public:
  struct Entry {
    std::uint32_t body, laser;
    std::uint64_t number;
    std::uint32_t next_of_body;
    std::uint32_t first_range = 0, ranges = 0;
    double first_angle_rad = 0, angle_step_rad = 0, range_max_m = 0;
  };

  /// Nothing is expected; the bodies are so many.
  void restart(std::size_t bodies);
  /// Each at most once a step.
  void expect(std::uint32_t body, std::uint32_t laser, std::uint64_t number);

  /// What was made is past; what was expected is to be made. False if there is none.
  bool begin();
  /// Calls make(entry, scan) for what is to be made of the body's, and keeps what it leaves in the scan.
  template <class Make>
  void make(std::uint32_t body, Make make);
  /// What was made is no longer so.
  void forget() { valid_ = false; }

  /// Copies what was made; false if that scan was not.
  bool find(std::uint32_t body, std::uint32_t laser, std::uint64_t number, LaserScan& out) const;

 private:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  /// Entries, and of each body the last of its own; others behind it.
  struct List {
    std::vector<Entry> entries;
    std::vector<std::uint32_t> of_body;

    void clear();
  };

  List coming_, made_;
  bool valid_ = false;
  std::vector<double> ranges_m_;  // of what was made
  LaserScan scan_;                // of one call, kept so that it allocates nothing
};

template <class Make>
void ExpectedScans::make(std::uint32_t body, Make make) {
  for (std::uint32_t at = made_.of_body[body]; at != none; at = made_.entries[at].next_of_body) {
    Entry& entry = made_.entries[at];
    make(entry, scan_);
    entry.first_range = static_cast<std::uint32_t>(ranges_m_.size());
    entry.ranges = static_cast<std::uint32_t>(scan_.range_m.size());
    entry.first_angle_rad = scan_.first_angle_rad;
    entry.angle_step_rad = scan_.angle_step_rad;
    entry.range_max_m = scan_.range_max_m;
    ranges_m_.insert(ranges_m_.end(), scan_.range_m.begin(), scan_.range_m.end());
  }
}

}  // namespace waitpoint::world
