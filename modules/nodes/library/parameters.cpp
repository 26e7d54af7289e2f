// SPDX-License-Identifier: BSD-3-Clause
#include "modules/nodes/library/parameters.hpp"

#include <algorithm>

namespace waitpoint::nodes {
namespace {

std::vector<std::string> parts_of(const std::string& key) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin < key.size();) {
    const std::size_t end = std::min(key.find('/', begin), key.size());
    if (end > begin) parts.push_back(key.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

std::string joined(const std::vector<std::string>& parts) {
  std::string key = "/";
  for (const std::string& part : parts) key += part + "/";
  return key;
}

bool is_tree(const Value& value) { return value.getType() == Value::TypeStruct; }

// Without const: the library's structures have no constant iterators.
void add_names(Value& tree, const std::string& above, std::vector<std::string>& names) {
  for (auto& [name, value] : tree)
    if (is_tree(value))
      add_names(value, above + name + "/", names);
    else
      names.push_back(above + name);
}

}  // namespace

Value empty_structure() {
  Value value;
  (void)value.begin();  // makes it one
  return value;
}

Parameters::Parameters() : root_(empty_structure()) {}

bool Parameters::set(const std::string& key, const Value& value) {
  const std::vector<std::string> parts = parts_of(key);
  if (parts.empty()) {
    if (!is_tree(value)) return false;
    root_ = value;
  } else {
    Value* place = &root_;
    for (const std::string& part : parts) {
      if (!is_tree(*place)) *place = empty_structure();
      place = &(*place)[part];
    }
    *place = value;
  }
  tell_of(joined(parts));
  return true;
}

std::optional<Value> Parameters::get(const std::string& key) const {
  const Value* place = &root_;
  for (const std::string& part : parts_of(key)) {
    if (!is_tree(*place) || !place->hasMember(part)) return std::nullopt;
    place = &(*place)[part];
  }
  return *place;
}

// The library has no call that takes a member out of a structure: it is copied without it.
bool Parameters::erase(const std::string& key) {
  std::vector<std::string> parts = parts_of(key);
  if (parts.empty() || !get(key)) return false;
  const std::string last = parts.back();
  parts.pop_back();
  Value above = *get(joined(parts));
  Value rest = empty_structure();
  for (auto& [name, value] : above)
    if (name != last) rest[name] = value;
  Value* place = &root_;
  for (const std::string& part : parts) place = &(*place)[part];
  *place = rest;
  parts.push_back(last);
  tell_of(joined(parts));
  return true;
}

std::optional<std::string> Parameters::search(const std::string& from, const std::string& key) const {
  if (key.empty() || key == "/") return std::nullopt;
  if (key.front() == '/') return get(key) ? std::optional(key) : std::nullopt;
  const std::string first = parts_of(key).front();
  for (std::vector<std::string> space = parts_of(from);; space.pop_back()) {
    if (get(joined(space) + first)) return joined(space) + key;
    if (space.empty()) return std::nullopt;
  }
}

std::vector<std::string> Parameters::names() const {
  std::vector<std::string> names;
  Value tree = root_;
  add_names(tree, "/", names);
  return names;
}

Value Parameters::subscribe(const std::string& address, const std::string& key) {
  std::vector<std::string>& addresses = subscribers_[joined(parts_of(key))];
  if (std::find(addresses.begin(), addresses.end(), address) == addresses.end()) addresses.push_back(address);
  return get(key).value_or(empty_structure());
}

bool Parameters::unsubscribe(const std::string& address, const std::string& key) {
  const auto found = subscribers_.find(joined(parts_of(key)));
  if (found == subscribers_.end() || std::erase(found->second, address) == 0) return false;
  if (found->second.empty()) subscribers_.erase(found);
  return true;
}

std::optional<ParameterChange> Parameters::take_change() {
  if (changes_.empty()) return std::nullopt;
  ParameterChange first = std::move(changes_.front());
  changes_.pop_front();
  return first;
}

// A subscriber above the change gets the change, a subscriber below it its own parameter.
void Parameters::tell_of(const std::string& key) {
  for (const auto& [subscribed, addresses] : subscribers_) {
    const bool above = key.starts_with(subscribed);
    if (!above && !subscribed.starts_with(key)) continue;
    const std::string& changed = above ? key : subscribed;
    for (const std::string& address : addresses)
      changes_.push_back({address, changed, get(changed).value_or(empty_structure())});
  }
}

}  // namespace waitpoint::nodes
