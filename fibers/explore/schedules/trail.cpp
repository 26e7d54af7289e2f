// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/schedules/trail.hpp"

#include <algorithm>

namespace waitpoint::exploration {
namespace {

constexpr std::string_view letters = "0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_+";
constexpr unsigned letter_bits = 6;
constexpr std::uint32_t letter_mask = (1u << letter_bits) - 1;
static_assert(letters.size() == letter_mask + 1);

}  // namespace

std::uint32_t log_spacing_for(std::uint64_t events) {
  std::uint32_t log_spacing = 0;
  while (events >> log_spacing > Trail::marks_max) ++log_spacing;
  return log_spacing;
}

std::string parting(const Trail& record, const Trail& run) {
  const auto [left, met] = std::mismatch(record.marks.begin(), record.marks.end(), run.marks.begin(), run.marks.end());
  const auto same = static_cast<std::uint64_t>(left - record.marks.begin()) * record.spacing();
  if (left == record.marks.end() || met == run.marks.end())
    return same == 0 ? "before its event " + std::to_string(record.spacing())
                     : "after its event " + std::to_string(same);
  if (record.spacing() == 1) return "at its event " + std::to_string(same + 1);
  return "at one of its events " + std::to_string(same + 1) + " to " + std::to_string(same + record.spacing());
}

std::string to_text(const Trail& trail) {
  if (trail.marks.empty()) return "";
  std::string text(1, letters[trail.log_spacing]);
  for (const std::uint16_t mark : trail.marks) {
    text += letters[mark >> letter_bits];
    text += letters[mark & letter_mask];
  }
  return text;
}

bool read_trail(std::string_view text, Trail& trail) {
  if (text.size() < 3 || text.size() % 2 != 1 || text.size() > 1 + 2 * Trail::marks_max) return false;
  if (text.find_first_not_of(letters) != std::string_view::npos) return false;
  const auto number = [&](std::size_t at) { return static_cast<std::uint32_t>(letters.find(text[at])); };
  trail.log_spacing = number(0);
  trail.marks.clear();
  for (std::size_t i = 1; i < text.size(); i += 2)
    trail.marks.push_back(static_cast<std::uint16_t>(number(i) << letter_bits | number(i + 1)));
  return true;
}

}  // namespace waitpoint::exploration
