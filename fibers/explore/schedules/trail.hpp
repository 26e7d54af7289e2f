// SPDX-License-Identifier: BSD-3-Clause
// A trail: bits of a run's digest at regular intervals, by which a token locates where another run diverges; the digest
// at its end only shows that it does.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace waitpoint::exploration {

struct Trail {
  static constexpr std::size_t marks_max = 8;

  std::uint32_t log_spacing = 0;     ///< one mark per 2^log_spacing events
  std::vector<std::uint16_t> marks;  ///< 12 bits each; empty: unknown

  std::uint64_t spacing() const { return std::uint64_t{1} << log_spacing; }
  /// Adds the mark for the current digest.
  void add(std::uint64_t digest) { marks.push_back(static_cast<std::uint16_t>(digest >> 52)); }

  friend bool operator==(const Trail&, const Trail&) = default;
};

/// The least spacing at which the marks of `events` fit.
std::uint32_t log_spacing_for(std::uint64_t events);

/// "at one of its events 33 to 48": the interval in which `run`, with the same spacing, diverges from `record`; after
/// all marks if in no other.
std::string parting(const Trail& record, const Trail& run);

/// Letters, digits, '_' and '+': one for the spacing, two for each mark; "" for an empty trail.
std::string to_text(const Trail& trail);
/// False if `text` is not a trail.
bool read_trail(std::string_view text, Trail& trail);

}  // namespace waitpoint::exploration
