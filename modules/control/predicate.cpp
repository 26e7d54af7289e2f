// SPDX-License-Identifier: BSD-3-Clause
#include "modules/control/predicate.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace waitpoint::control {
namespace {

// A value from each interval between the numbers that any comparison of the path has, and these numbers: between them
// no comparison changes its value.
std::vector<double> samples(const std::string& path, const RequestPattern& a, const RequestPattern& b) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<double> values{-infinity, infinity};
  for (const RequestPattern* pattern : {&a, &b})
    for (const Comparison& input : pattern->inputs)
      if (input.path == path) values.push_back(input.number);
  std::sort(values.begin(), values.end());
  const std::size_t count = values.size();
  for (std::size_t i = 2; i + 1 < count; ++i) values.push_back(std::midpoint(values[i - 1], values[i]));
  return values;
}

bool meets(const RequestPattern& pattern, const std::string& path, double value) {
  return std::all_of(pattern.inputs.begin(), pattern.inputs.end(), [&](const Comparison& input) {
    return input.path != path || holds(input.relation, value, input.number);
  });
}

bool mentions(const RequestPattern& pattern, const std::string& path) {
  return std::any_of(pattern.inputs.begin(), pattern.inputs.end(),
                     [&](const Comparison& input) { return input.path == path; });
}

}  // namespace

bool holds(Relation relation, double value, double number) {
  switch (relation) {
    case Relation::less: return value < number;
    case Relation::less_equal: return value <= number;
    case Relation::equal: return value == number;
    case Relation::not_equal: return value < number || value > number;
    case Relation::greater_equal: return value >= number;
    case Relation::greater: return value > number;
  }
  return false;
}

// An absent field meets no comparison: so a path that only `b` mentions is no implication.
bool implies(const RequestPattern& a, const RequestPattern& b) {
  return std::all_of(b.inputs.begin(), b.inputs.end(), [&](const Comparison& input) {
    if (!mentions(a, input.path)) return false;
    const std::vector<double> values = samples(input.path, a, b);
    return std::none_of(values.begin(), values.end(), [&](double value) {
      return meets(a, input.path, value) && !holds(input.relation, value, input.number);
    });
  });
}

bool is_empty(const RequestPattern& pattern) {
  return std::any_of(pattern.inputs.begin(), pattern.inputs.end(), [&](const Comparison& input) {
    const std::vector<double> values = samples(input.path, pattern, pattern);
    return std::none_of(values.begin(), values.end(), [&](double value) { return meets(pattern, input.path, value); });
  });
}

bool is_same_request(const RequestPattern& a, const RequestPattern& b) {
  return a.module == b.module && a.request == b.request;
}

bool is_one_of_both(const RequestPattern& a, const RequestPattern& b) {
  RequestPattern both = a;
  both.inputs.insert(both.inputs.end(), b.inputs.begin(), b.inputs.end());
  return is_same_request(a, b) && !is_empty(both);
}

std::string request_name(const RequestPattern& pattern) { return pattern.module + "." + pattern.request; }

}  // namespace waitpoint::control
