// SPDX-License-Identifier: BSD-3-Clause
#include "core/field_facts.hpp"

#include <algorithm>
#include <iterator>

namespace waitpoint {
namespace {

struct Unit {
  std::string_view ending, unit;
};
// An ending that is the end of another one is behind it.
constexpr Unit units[] = {
    {"_rad_s2", "rad/s2"}, {"_m_s2", "m/s2"},  {"_deg_s", "deg/s"},   {"_rad_s", "rad/s"}, {"_bit_s", "bit/s"},
    {"_m_s", "m/s"},       {"_bytes", "byte"}, {"_celsius", "deg C"}, {"_deg", "deg"},     {"_rad", "rad"},
    {"_ohm", "ohm"},       {"_ah", "Ah"},      {"_kg", "kg"},         {"_hz", "Hz"},       {"_ms", "ms"},
    {"_us", "us"},         {"_ns", "ns"},      {"_m", "m"},           {"_s", "s"},         {"_v", "V"},
    {"_a", "A"},           {"_n", "N"},        {"_h", "h"},
};

}  // namespace

std::string_view unit_of(std::string_view name) {
  for (const std::string_view bound : {"_max", "_min"})
    if (name.ends_with(bound)) name.remove_suffix(bound.size());
  if (name.find("_per_") != std::string_view::npos) return {};
  const auto* const unit =
      std::find_if(std::begin(units), std::end(units), [&](const Unit& u) { return name.ends_with(u.ending); });
  return unit == std::end(units) ? std::string_view() : unit->unit;
}

}  // namespace waitpoint
