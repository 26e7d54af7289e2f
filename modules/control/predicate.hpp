// SPDX-License-Identifier: BSD-3-Clause
// The variables of compiled rules: finite-state predicates over the functional level, and the bits of memory that the
// temporal operators need.
#pragma once

#include <string>
#include <vector>

#include "modules/control/rules.hpp"

namespace waitpoint::control {

struct Predicate {
  enum class Kind : std::uint8_t {
    requested,
    running,
    succeeded,
    failed,
    lasting,        ///< for longer than `time`
    present,        ///< the field has a value: given, not beyond the array, no NaN
    greater,        ///< the field is present and > `number`
    greater_equal,  ///< the field is present and >= `number`
    given,
    aged,    ///< the poster is older than `time`, or not given
    memory,  ///< of a temporal operator, in the steps before
  };
  Kind kind = Kind::memory;
  std::size_t pattern = 0;             ///< of the first five kinds: index among the patterns
  std::string poster = {}, path = {};  ///< "module.poster", and the field's path within its value
  double number = 0;
  Duration time = {};
  Place place = {};  ///< of its first use

  bool is_of_request() const { return kind <= Kind::lasting; }
};

/// True if every input that meets pattern `a` meets `b`, too; both are of one request type.
bool implies(const RequestPattern& a, const RequestPattern& b);
/// True if no input meets the pattern.
bool is_empty(const RequestPattern& pattern);
bool is_same_request(const RequestPattern& a, const RequestPattern& b);
/// True if one request can meet both patterns.
bool is_one_of_both(const RequestPattern& a, const RequestPattern& b);

/// "ndd.GoTo"
std::string request_name(const RequestPattern& pattern);

bool holds(Relation relation, double value, double number);

}  // namespace waitpoint::control
