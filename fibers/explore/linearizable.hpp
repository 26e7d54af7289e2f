// SPDX-License-Identifier: BSD-3-Clause
// Checks that concurrent operations on an object had their effects one after another, each at some moment between its
// invocation and its response, as those of a sequential model: linearizability (Herlihy and Wing 1990).
//
//   struct Fifo {                                             // the model: a sequential queue
//     struct Operation { const char* name; int value; };      // with an operator<<
//     using Result = std::optional<int>;                      // of all operations; no value: push(), or empty
//     std::deque<int> values;
//     Result apply(const Operation& operation);
//     bool operator==(const Fifo&) const = default;
//   };
//
//   waitpoint::explore([] {
//     Queue queue;                                            // the code under test
//     waitpoint::History<Fifo> history;
//     waitpoint::thread one([&] { history.record({"push", 1}, [&] { queue.push(1); }); });
//     waitpoint::thread two([&] { history.record({"pop", 0}, [&] { return queue.pop(); }); });
//     one.join(), two.join();
//     waitpoint::check(waitpoint::linearizable(history, Fifo()));
//   });
//
// If operations on different keys are independent, as those of a map, the model may have a function
// `key(const Operation&)` whose result has < and an operator<<. The history is then checked key by key, each part from
// the initial model: a history is linearizable if and only if each part is (Herlihy and Wing's locality;
// P-compositionality in Horn and Kroening 2015), and the parts are much cheaper.
#pragma once

#include <map>
#include <type_traits>
#include <utility>

#include "fibers/explore/check.hpp"
#include "fibers/explore/linearizability/history.hpp"
#include "fibers/explore/linearizability/history_part.hpp"
#include "fibers/explore/linearizability/linearizability.hpp"
#include "fibers/explore/linearizability/sequential_model.hpp"
#include "fibers/explore/linearizability/value_text.hpp"

namespace waitpoint {

/// Decides whether `history` has a linearization from the state `model`. A pending operation may have had its effect or
/// not. A result that is not linearizable is that of the least key whose part is not.
template <SequentialModel Model>
Linearizability linearizable(const History<Model>& history, const Model& model,
                             const LinearizabilityOptions& options = {}) {
  const sync::IgnoredAccesses ignored_accesses;
  if constexpr (KeyedModel<Model>) {
    std::map<std::remove_cvref_t<decltype(model.key(history.entries().front().operation))>, exploration::Entries<Model>>
        parts;
    for (const auto& entry : history.entries()) parts[model.key(entry.operation)].push_back(&entry);
    Linearizability undecided;
    for (const auto& [key, entries] : parts) {
      Linearizability result = exploration::check_part(entries, model, options);
      if (result.verdict == Linearizability::Verdict::linearizable) continue;
      result.key = exploration::value_text(key);
      if (result.verdict == Linearizability::Verdict::not_linearizable) return result;
      undecided = std::move(result);
    }
    return undecided;
  } else {
    exploration::Entries<Model> entries;
    for (const auto& entry : history.entries()) entries.push_back(&entry);
    return exploration::check_part(entries, model, options);
  }
}

/// Within a task: fails the run here if the history is not linearizable, or the search undecided.
inline void check(const Linearizability& result, const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
  if (!result) check(false, exploration::value_text(result).c_str(), file, line);
}

}  // namespace waitpoint
