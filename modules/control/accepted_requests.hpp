// SPDX-License-Identifier: BSD-3-Clause
// The state of the functional level as the control knows it: requests that it has accepted and that have not ended.
//
// A request counts as running from its acceptance to its final reply: longer than its activity runs, never shorter.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "modules/control/automaton.hpp"
#include "modules/genom/module.hpp"

namespace waitpoint::control {

struct ControlledRequest {
  genom::Module* module = nullptr;
  genom::Letter letter;  ///< from the client
  std::uint32_t number = 0;
  std::vector<std::size_t> patterns;  ///< of the rules, that it meets
  Time accepted = {};
  std::int32_t activity = -1;   ///< its number, from the intermediate reply on
  bool is_interrupted = false;  ///< an abort was sent, or will be when the activity's number is known
};

class AcceptedRequests {
 public:
  explicit AcceptedRequests(const Automaton& automaton) : automaton_(automaton) {}

  ControlledRequest& add(const ControlledRequest& request) { return requests_[request.number] = request; }
  /// Null if no such request is running.
  ControlledRequest* find(std::uint32_t number);
  void remove(std::uint32_t number) { requests_.erase(number); }
  /// By number: the oldest first.
  std::map<std::uint32_t, ControlledRequest>& running() { return requests_; }

  /// The difference of a state from the present one.
  struct Change {
    const ControlledRequest* accepted = nullptr;  ///< in this step
    const ControlledRequest* ended = nullptr;     ///< in this step, and removed
    bool is_success = false;                      ///< of the ended one
    std::vector<std::uint32_t> without;           ///< running ones that are left out
  };
  /// Sets the values of all predicates about requests.
  void evaluate(const Change& change, Time now, std::vector<bool>& values) const;

  /// When the value of a predicate about a duration next changes; nothing if none does by itself.
  std::optional<Time> next_change(Time now) const;

 private:
  bool value_of(const Predicate& predicate, const Change& change, Time now) const;

  const Automaton& automaton_;
  std::map<std::uint32_t, ControlledRequest> requests_;
};

}  // namespace waitpoint::control
