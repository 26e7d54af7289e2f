// SPDX-License-Identifier: BSD-3-Clause
// Random histories of concurrent operations, and a decision by trying all orders.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <optional>
#include <random>
#include <vector>

#include "fibers/explore/linearizable.hpp"
#include "tests/fibers/explore/linearizability/models.hpp"

namespace waitpoint::histories {

/// An operation of each kind, of a model with such contents; the value makes pushed elements distinct.
inline models::Operation random_operation(const models::Fifo&, std::minstd_rand& draw, int value) {
  return draw() % 2 == 0 ? models::Operation{"push", value} : models::Operation{"pop"};
}
inline models::Operation random_operation(const models::Stack&, std::minstd_rand& draw, int value) {
  return random_operation(models::Fifo(), draw, value);
}
inline models::Operation random_operation(const models::Register&, std::minstd_rand& draw, int value) {
  return draw() % 2 == 0 ? models::Operation{"write", value} : models::Operation{"read"};
}
inline models::Operation random_operation(const models::Map&, std::minstd_rand& draw, int value) {
  const int key = static_cast<int>(draw() % 10) + 1;
  switch (draw() % 3) {
    case 0: return {"put", value, key};
    case 1: return {"get", 0, key};
    default: return {"take", 0, key};
  }
}

/// `count` operations of `clients` at a time, each with an effect between its events: a linearizable history. If
/// `wrong`, about one result in so many is another value; some operations stay pending if `pending`.
template <class Model>
History<Model> random_history(std::uint32_t seed, std::size_t count, std::size_t clients,
                              std::optional<std::size_t> wrong, bool pending = false) {
  struct Client {
    std::size_t number = 0;
    std::optional<models::Operation> operation;
    bool done = false;
    std::optional<int> result;
  };
  std::minstd_rand draw(seed + 1);
  std::vector<Client> running(clients);
  History<Model> history;
  Model model;
  for (std::size_t invoked = 0, responded = 0; responded + (pending ? clients / 2 : 0) < count;) {
    Client& client = running[draw() % clients];
    if (!client.operation) {
      if (invoked == count) continue;
      client.operation = random_operation(model, draw, static_cast<int>(++invoked));
      client.number = history.invoke(*client.operation);
    } else if (!client.done) {
      client.result = model.apply(*client.operation);
      client.done = true;
    } else {
      if (wrong && draw() % *wrong == 0) client.result = static_cast<int>(draw() % count) + 1;
      history.respond(client.number, client.result);
      client = {};
      ++responded;
    }
  }
  return history;
}

/// Tries all orders of all subsets of the pending operations.
template <class Model>
bool has_linearization(const std::vector<const typename History<Model>::Entry*>& left, const Model& model) {
  if (std::none_of(left.begin(), left.end(), [](auto* entry) { return entry->result.has_value(); })) return true;
  for (std::size_t i = 0; i < left.size(); ++i) {
    const bool is_first = std::none_of(
        left.begin(), left.end(), [&](auto* other) { return other->interval.responded < left[i]->interval.invoked; });
    if (!is_first) continue;
    Model next = model;
    const auto result = next.apply(left[i]->operation);
    if (left[i]->result && result != *left[i]->result) continue;
    auto others = left;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    if (has_linearization(others, next)) return true;
  }
  return false;
}

template <class Model>
bool has_linearization(const History<Model>& history) {
  std::vector<const typename History<Model>::Entry*> all;
  for (const auto& entry : history.entries()) all.push_back(&entry);
  return has_linearization(all, Model());
}

}  // namespace waitpoint::histories
