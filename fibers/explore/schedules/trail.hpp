// SPDX-License-Identifier: BSD-3-Clause
// What a token keeps of the way of a run, beside the digest at its end: some bits of the digest after every so many
// events, by which it is seen where another run leaves it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace waitpoint::exploration {

struct Trail {
  static constexpr std::size_t marks_max = 8;

  std::uint32_t log_spacing = 0;     ///< a mark stands behind each 2^log_spacing events
  std::vector<std::uint16_t> marks;  ///< 12 bits each; empty: nothing is known

  std::uint64_t spacing() const { return std::uint64_t{1} << log_spacing; }
  /// The digest behind the next of its marks.
  void add(std::uint64_t digest) { marks.push_back(static_cast<std::uint16_t>(digest >> 52)); }

  friend bool operator==(const Trail&, const Trail&) = default;
};

/// The least that leaves room for the marks of so many events.
std::uint32_t log_spacing_for(std::uint64_t events);

/// "at one of its events 33 to 48": where `run`, with the same spacing, leaves `record`; behind all marks if nowhere
/// else.
std::string parting(const Trail& record, const Trail& run);

/// Letters, digits, '_' and '+': one for the spacing, two for each mark; nothing where nothing is known.
std::string to_text(const Trail& trail);
/// False if `text` is none.
bool read_trail(std::string_view text, Trail& trail);

}  // namespace waitpoint::exploration
