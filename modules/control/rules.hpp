// SPDX-License-Identifier: BSD-3-Clause
// The rules of a robot's execution control, as written: contexts of checks over the state of the functional level.
//
//   cost 50 us;                                      # of one step of the controller
//   context mast {
//     check stowed {
//       fail: running(ndd.GoTo) && mast.state.height_m > 0;
//       delay: ndd.GoTo for 20 s;
//     }
//   }
//
// In the form of ExoGen, the language of LAAS's execution controller R2C (Py, Ingrand, "Dependable execution control
// for autonomous robots", IROS 2004). docs/laas-control.md is the reference. Names are resolved later, against the
// modules of a robot: model.hpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "core/time.hpp"

namespace waitpoint::control {

/// A place in the file; both count from 1.
struct Place {
  int line = 1, column = 1;
};

enum class Relation : std::uint8_t { less, less_equal, equal, not_equal, greater_equal, greater };

/// `path relation number`; the path is of a request's input, or "module.poster.field".
struct Comparison {
  std::string path;
  Relation relation = Relation::greater;
  double number = 0;
  Place place;
};

/// "ndd.GoTo(via.size > 2)": the requests of one type whose inputs meet all comparisons.
struct RequestPattern {
  std::string module, request;
  std::vector<Comparison> inputs;
  Place place;
};

struct Expression {
  enum class Kind : std::uint8_t {
    constant,     ///< `truth`
    requested,    ///< request(pattern): accepted in this step
    running,      ///< running(pattern): accepted, and not ended
    succeeded,    ///< succeeded(pattern): ended in this step with report ok
    failed,       ///< failed(pattern): ended in this step with another report
    lasting,      ///< duration(pattern) > time: running for longer
    comparison,   ///< of a field of a poster
    given,        ///< given(poster): has been written
    aged,         ///< age(poster) > time: not written for longer, or never
    negation,     ///< of operand 0
    conjunction,  ///< of all operands
    disjunction,
    past,    ///< past(e): e holds or held
    always,  ///< always(e): e holds and held in every step
    never,   ///< never(e): e neither holds nor held
    since,   ///< since(e, f): f holds or held, and e has held in every step since
  };
  Kind kind = Kind::constant;
  bool truth = false;
  RequestPattern pattern;
  Comparison comparison;
  std::string poster;  ///< "module.poster"
  Duration time;
  std::vector<Expression> operands;
  Place place;
};

/// A state that must not be reached, and the action against it. A request that would lead to it is rejected, unless
/// a pattern below matches it or another activity gives way.
struct Check {
  std::string name;      ///< "context.check"
  Expression forbidden;  ///< including the context's `when`
  std::vector<RequestPattern> delayed;
  Duration delay_max;
  /// Activities that give way, to a state as to a request, which then waits for their end.
  std::vector<RequestPattern> interrupted;
  Duration interruption_max;
  Place place;
};

struct Rules {
  static constexpr Duration period_default = std::chrono::milliseconds(100);

  std::string file;
  Duration cost;                     ///< of one step
  Duration period = period_default;  ///< of steps without a letter, for rules about posters
  std::vector<Check> checks;
};

/// BadInput "file:line: column C: message".
BadInput bad(const std::string& file, Place place, const std::string& message);

}  // namespace waitpoint::control
