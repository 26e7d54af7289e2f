// SPDX-License-Identifier: BSD-3-Clause
// The check of a history, or of the part of it that concerns one key.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "fibers/explore/linearizability/history.hpp"
#include "fibers/explore/linearizability/linearizability.hpp"
#include "fibers/explore/linearizability/linearization.hpp"
#include "fibers/explore/linearizability/value_text.hpp"

namespace waitpoint {

namespace exploration {

/// The part's operations in the order of invocation.
template <class Model>
using Entries = std::vector<const typename History<Model>::Entry*>;

template <class Model>
HistoryPicture picture_of(const Entries<Model>& entries) {
  HistoryPicture picture;
  for (const auto* entry : entries) {
    std::string text = value_text(entry->operation);
    if (!entry->result) text += " ...";
    if (entry->returns) text += " -> " + value_text(*entry->result);
    picture.rows.push_back({entry->task, std::move(text), entry->interval});
  }
  return picture;
}

/// Marks the longest prefix with a linearization in `picture`; false if it was not found. The prefixes of a
/// linearizable history are linearizable: it is searched among those that end with a response, from short ones on, as a
/// bad response early in a long history needs a short search.
template <class Model>
bool mark_prefix(HistoryPicture& picture, const Entries<Model>& entries, const Model& model, std::uint64_t limit) {
  std::map<std::uint32_t, std::size_t> responses;
  for (std::size_t i = 0; i < entries.size(); ++i)
    if (entries[i]->result) responses.emplace(entries[i]->interval.responded, i);
  const std::vector<std::pair<std::uint32_t, std::size_t>> ends(responses.begin(), responses.end());
  // With `low` responses it is linearizable, with `high` it is not, as far as that is known.
  std::size_t low = 0, high = ends.size() + 1;
  for (std::size_t next = 1; low + 1 < high;
       next = high <= ends.size() ? (low + high) / 2 : std::min(2 * low, ends.size())) {
    const Linearized found = Linearization<Model>(entries, model, ends[next - 1].first + 1, limit).result();
    if (found == Linearized::undecided) return false;
    (found == Linearized::yes ? low : high) = next;
  }
  if (high > ends.size()) return false;
  const Linearization<Model> prefix(entries, model, ends[high - 1].first, limit);
  if (prefix.result() == Linearized::undecided) return false;
  picture.bad = ends[high - 1].second;
  for (std::size_t i = 0; i < prefix.order().size(); ++i) picture.rows[prefix.order()[i]].place = i + 1;
  return true;
}

/// If the search among all operations is undecided, a prefix may still decide it.
template <class Model>
Linearizability check_part(const Entries<Model>& entries, const Model& model, const LinearizabilityOptions& options) {
  using Verdict = Linearizability::Verdict;
  const std::uint64_t limit = options.configurations_max;
  Linearizability result;
  const Linearized whole = Linearization<Model>(entries, model, Interval::pending, limit).result();
  if (whole == Linearized::yes) return result;
  result.picture = picture_of<Model>(entries);
  const bool is_marked = mark_prefix(result.picture, entries, model, limit);
  result.verdict = is_marked || whole == Linearized::no ? Verdict::not_linearizable : Verdict::undecided;
  result.configurations_max = limit;
  return result;
}

}  // namespace exploration
}  // namespace waitpoint
