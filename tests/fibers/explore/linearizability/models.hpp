// SPDX-License-Identifier: BSD-3-Clause
// Sequential models: a queue, a stack, a register, a map.
#pragma once

#include <map>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace waitpoint::models {

/// "push 3", "pop".
struct Operation {
  std::string name;
  int value = 0;  ///< 0: none
  int key = 0;    ///< 0: none
};

inline std::ostream& operator<<(std::ostream& out, const Operation& operation) {
  out << operation.name;
  if (operation.key != 0) out << " " << operation.key;
  if (operation.value != 0) out << " " << operation.value;
  return out;
}

/// What the model holds; equal contents are equal states.
template <class Contents>
struct Model {
  using Operation = models::Operation;
  using Result = std::optional<int>;  ///< none of what changes the contents, and where there is nothing

  Contents contents{};

  bool operator==(const Model&) const = default;
};

struct Elements : Model<std::vector<int>> {
  std::size_t hash() const {
    std::size_t hash = contents.size();
    for (const int element : contents) hash = hash * 31 + static_cast<std::size_t>(element);
    return hash;
  }
};

struct Fifo : Elements {
  Result apply(const Operation& operation) {
    if (operation.name == "push") return contents.push_back(operation.value), std::nullopt;
    if (contents.empty()) return std::nullopt;
    const int first = contents.front();
    contents.erase(contents.begin());
    return first;
  }
};

struct Stack : Elements {
  Result apply(const Operation& operation) {
    if (operation.name == "push") return contents.push_back(operation.value), std::nullopt;
    if (contents.empty()) return std::nullopt;
    const int last = contents.back();
    contents.pop_back();
    return last;
  }
};

struct Register : Model<int> {
  Result apply(const Operation& operation) {
    if (operation.name == "write") return contents = operation.value, std::nullopt;
    return contents;
  }
};

struct Map : Model<std::map<int, int>> {
  Result apply(const Operation& operation) {
    if (operation.name == "put") return contents[operation.key] = operation.value, std::nullopt;
    const auto found = contents.find(operation.key);
    if (found == contents.end()) return std::nullopt;
    const int value = found->second;
    if (operation.name == "take") contents.erase(found);
    return value;
  }
};

struct MapByKeys : Map {
  int key(const Operation& operation) const { return operation.key; }
};

}  // namespace waitpoint::models
