// SPDX-License-Identifier: BSD-3-Clause
// The rules' names bound to the modules and posters of one robot, with the types of fields checked.
#pragma once

#include <vector>

#include "modules/control/automaton.hpp"
#include "modules/genom/module.hpp"
#include "modules/genom/name_space.hpp"

namespace waitpoint::control {

class Bindings {
 public:
  /// BadInput for a module, request, poster or field that the robot does not have. All must outlive the bindings.
  Bindings(const Rules& rules, const Automaton& automaton, const genom::NameSpace& names);

  /// The patterns that a request meets.
  std::vector<std::size_t> patterns_of(const genom::Module& module, const genom::Letter& request) const;

  bool has_posters() const { return !posters_.empty(); }
  /// Reads all posters and sets the values of the predicates about them, each poster's from one value of it.
  void observe(std::vector<bool>& values);

 private:
  struct Request {
    const genom::Module* module;
    std::uint32_t number;
  };
  struct ReadPoster {
    genom::PosterBase* poster;
    std::vector<FieldReading> readings;
    std::vector<std::size_t> reading_of;  // by predicate of `predicates`
    std::vector<std::size_t> predicates;
  };

  void bind(const RequestPattern& pattern, const genom::NameSpace& names);
  void expect_activity(const RequestPattern& pattern) const;
  void bind(std::size_t variable, const genom::NameSpace& names);

  const Rules& rules_;
  const Automaton& automaton_;
  std::vector<Request> requests_;  // by pattern
  std::vector<ReadPoster> posters_;
};

}  // namespace waitpoint::control
