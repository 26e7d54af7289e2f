// SPDX-License-Identifier: BSD-3-Clause
// What a declaration says of a field beside its name and its member, for what reads, describes and draws values:
//
//   field("range_noise_m", &Laser::range_noise_m, ranges::length_error, "standard deviation, to 8 m");
//   field("field_of_view_deg", &Laser::field_of_view_rad, degrees, fan, "from the first beam to the last");
//   field("beams", &Laser::beams, CountRange{2, 2881}, "number of beams");
//   field("kind", &Base::kind, Words{kinds}, "how it moves");
//
// The facts may be in any order, each may be missing. A field's unit is that at the end of its name; its default is
// that of a default-constructed value.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "core/number_range.hpp"

namespace waitpoint {

/// Marks a field that was added after runs with its type were published: core/fields.hpp.
struct Added {};
inline constexpr Added added;

/// Marks a field without which its object is not valid.
struct Required {};
inline constexpr Required required;

/// Marks a member in radians whose name and range are in degrees.
struct Degrees {};
inline constexpr Degrees degrees;

/// The words of an enumeration, in the order of its values from 0; of static storage.
struct Words {
  std::span<const std::string_view> words;
};

struct FieldFacts {
  std::string_view description;  ///< a phrase without a full stop; may be empty
  std::optional<NumberRange> range;
  std::optional<CountRange> count;
  std::span<const std::string_view> words;
  bool is_added = false, is_required = false, is_degrees = false;
};

namespace internal {

constexpr void take_fact(FieldFacts& facts, const char* description) { facts.description = description; }
constexpr void take_fact(FieldFacts& facts, const NumberRange& range) { facts.range = range; }
constexpr void take_fact(FieldFacts& facts, const CountRange& count) { facts.count = count; }
constexpr void take_fact(FieldFacts& facts, const Words& words) { facts.words = words.words; }
constexpr void take_fact(FieldFacts& facts, Added) { facts.is_added = true; }
constexpr void take_fact(FieldFacts& facts, Required) { facts.is_required = true; }
constexpr void take_fact(FieldFacts& facts, Degrees) { facts.is_degrees = true; }

}  // namespace internal

constexpr FieldFacts facts_of(const auto&... given) {
  FieldFacts facts;
  (internal::take_fact(facts, given), ...);
  return facts;
}

/// The unit at the end of a name: "m/s" of "v_max_m_s"; empty without one. "_max" and "_min" may follow it.
std::string_view unit_of(std::string_view name);

}  // namespace waitpoint
