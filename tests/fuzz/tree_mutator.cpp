// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fuzz/tree_mutator.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <iterator>
#include <string_view>
#include <utility>

#include "core/number_text.hpp"

namespace waitpoint::fuzz {
namespace {

using scenario::YamlEntry;
using scenario::YamlNode;

constexpr std::string_view edges[] = {
    "0",      "-0",     "1",      "-1",         "2",          "0.5",        "1e-12",
    "9e-13",  "1e-9",   "1e-6",   "1e-3",       "10",         "89",         "90",
    "180",    "360",    "1000",   "1e4",        "1e5",        "-1e5",       "100001",
    "1e6",    "1e9",    "-1e9",   "1e10",       "1e12",       "1e18",       "1e300",
    "1e308",  "-1e308", "5e-324", "nan",        "inf",        "65535",      "65536",
    "100000", "1e7",    "3600",   "2147483647", "2147483648", "4294967296", "18446744073709551615"};
constexpr std::string_view words[] = {"true", "false", "fcl",  "slice", "bullet",       "differential", "aerial",
                                      "omni", "fixed", "cpu",  "x0.5",  "proportional", "interval",     "lms200",
                                      "all",  "a",     "x1e9", "base",  "laser",        "nowhere"};
constexpr double scales[] = {-1, 1e-6, 1e-3, 0.1, 0.5, 0.9, 1.1, 2, 10, 1e3, 1e6};

std::size_t below(std::size_t count, std::minstd_rand& random) { return count == 0 ? 0 : random() % count; }

template <class List>
const auto& one_of(const List& list, std::minstd_rand& random) {
  return *(std::begin(list) + static_cast<std::ptrdiff_t>(below(std::size(list), random)));
}

/// A value of a document and the key above it.
struct Place {
  YamlNode* node;
  std::string key;
};

void collect(YamlNode& node, const std::string& key, std::vector<Place>& places) {
  places.push_back({&node, key});
  for (YamlNode& item : node.items) collect(item, key, places);
  for (YamlEntry& entry : node.entries) collect(entry.value, entry.key, places);
}

bool is_number(const YamlNode& node) {
  double number = 0;
  return node.kind == YamlNode::Kind::scalar && parse_number(node.text, number);
}

void change_number(std::vector<Place>& places, std::minstd_rand& random) {
  std::erase_if(places, [](const Place& place) { return !is_number(*place.node); });
  if (places.empty()) return;
  YamlNode& node = *one_of(places, random).node;
  node.text = other_number(node.text, random);
}

void change_word(YamlNode& node, std::minstd_rand& random) {
  if (node.kind == YamlNode::Kind::scalar) node.text = one_of(words, random);
}

/// Another name for a copy, since names are unique.
void rename(YamlNode& node, std::minstd_rand& random) {
  if (YamlEntry* name = node.entry("name")) name->value.text += std::to_string(below(100, random));
}

void add_part(const Place& place, const Vocabulary& vocabulary, std::minstd_rand& random) {
  if (place.node->kind == YamlNode::Kind::list) {
    if (const YamlNode* item = vocabulary.item(place.key, random)) place.node->items.push_back(*item);
  } else if (const YamlEntry* part = vocabulary.entry(place.key, random)) {
    if (place.node->is_null()) place.node->kind = YamlNode::Kind::map;
    if (place.node->kind != YamlNode::Kind::map) return;
    if (YamlEntry* old = place.node->entry(part->key))
      old->value = part->value;
    else
      place.node->entries.push_back(*part);
  }
}

void repeat_part(YamlNode& node, std::minstd_rand& random) {
  if (node.items.empty()) return;
  node.items.push_back(one_of(node.items, random));
  if (below(4, random) > 0) rename(node.items.back(), random);
}

void remove_part(YamlNode& node, std::minstd_rand& random) {
  if (!node.items.empty())
    node.items.erase(node.items.begin() + static_cast<std::ptrdiff_t>(below(node.items.size(), random)));
  else if (!node.entries.empty())
    node.entries.erase(node.entries.begin() + static_cast<std::ptrdiff_t>(below(node.entries.size(), random)));
}

bool contains(YamlNode& whole, const YamlNode& part) {
  std::vector<Place> places;
  collect(whole, "", places);
  return std::any_of(places.begin(), places.end(), [&](const Place& place) { return place.node == &part; });
}

void exchange(YamlNode& a, YamlNode& b) {
  if (!contains(a, b) && !contains(b, a)) std::swap(a, b);
}

void change_key(YamlNode& node, const Vocabulary& vocabulary, const std::string& key, std::minstd_rand& random) {
  if (node.entries.empty()) return;
  const YamlEntry* other = vocabulary.entry(key, random);
  if (other != nullptr && node.entry(other->key) == nullptr)
    node.entries[below(node.entries.size(), random)].key = other->key;
}

void change(YamlNode& document, const Vocabulary& vocabulary, std::minstd_rand& random) {
  std::vector<Place> places;
  collect(document, "", places);
  const Place place = one_of(places, random);
  constexpr std::size_t kinds = 16;
  switch (below(kinds, random)) {
    case 0: change_word(*place.node, random); break;
    case 1: repeat_part(*place.node, random); break;
    case 2: remove_part(*place.node, random); break;
    case 3: change_key(*place.node, vocabulary, place.key, random); break;
    case 4: {
      const YamlNode copy = *one_of(places, random).node;
      *place.node = copy;
      break;
    }
    case 5: exchange(*place.node, *one_of(places, random).node); break;
    case 6:
    case 7:
    case 8:
    case 9: add_part(place, vocabulary, random); break;
    default: change_number(places, random); break;
  }
}

}  // namespace

std::string other_number(const std::string& text, std::minstd_rand& random) {
  double number = 0;
  if (below(2, random) == 0 || !parse_number(text, number)) return std::string(one_of(edges, random));
  std::array<char, 32> digits{};
  std::snprintf(digits.data(), digits.size(), "%.12g", number * one_of(scales, random));
  return digits.data();
}

const YamlEntry* Vocabulary::entry(const std::string& key, std::minstd_rand& random) const {
  const auto known = entries_.find(key);
  return known == entries_.end() ? nullptr : &one_of(known->second, random);
}

const YamlNode* Vocabulary::item(const std::string& key, std::minstd_rand& random) const {
  const auto known = items_.find(key);
  return known == items_.end() ? nullptr : &one_of(known->second, random);
}

void Vocabulary::learn(const YamlNode& node, const std::string& key) {
  for (const YamlNode& item : node.items) {
    items_[key].push_back(item);
    learn(item, key);
  }
  for (const YamlEntry& entry : node.entries) {
    entries_[key].push_back(entry);
    learn(entry.value, entry.key);
  }
}

void mutate(YamlNode& document, const Vocabulary& vocabulary, std::minstd_rand& random) {
  constexpr std::size_t changes_max = 4;
  for (std::size_t left = 1 + below(changes_max, random); left > 0; --left) change(document, vocabulary, random);
}

}  // namespace waitpoint::fuzz
