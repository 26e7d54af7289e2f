// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/yaml_builder.hpp"

#include <algorithm>

namespace waitpoint::scenario {
namespace {

constexpr std::size_t depth_max = 32;
constexpr std::size_t values_of_any_text = 20'000;
// A line of a robot that is an alias and a start has several values for each of its bytes.
constexpr std::size_t values_per_byte = 8;
constexpr std::size_t values_max = 16'000'000;
// Number of entries from which a set finds a key sooner than the entries in their order.
constexpr std::size_t many_entries = 32;

bool is_merge(const YamlNode& key) { return key.text == "<<" && !key.quoted; }

/// Appends the entries of `from` whose keys `map` does not have.
void merge(YamlNode& map, const YamlNode& from) {
  std::set<std::string, std::less<>> keys;
  for (const YamlEntry& entry : map.entries) keys.insert(entry.key);
  for (const YamlEntry& entry : from.entries)
    if (!keys.contains(entry.key)) map.entries.push_back(entry);
}

}  // namespace

YamlBuilder::YamlBuilder(const std::string& file, bool file_has_lines, std::size_t size)
    : file_(file),
      file_has_lines_(file_has_lines),
      count_max_(std::min(values_of_any_text + values_per_byte * size, values_max)) {
  root_.written = location(YAML::Mark());
}

YamlNode YamlBuilder::take() {
  if (no_word_) throw no_word_->bad("expected a word as key");
  return std::move(root_);
}

Location YamlBuilder::location(const YAML::Mark& mark) const {
  return {file_, file_has_lines_ ? std::max(mark.line, 0) + 1 : 0};
}

void YamlBuilder::count(std::size_t values, int height, const Location& written) {
  count_ += values;
  if (count_ > count_max_)
    throw written.bad("more than " + std::to_string(count_max_) + " values: an anchor that multiplies itself?");
  if (open_.size() + static_cast<std::size_t>(height) > depth_max)
    throw written.bad("values are nested more than 32 deep");
}

void YamlBuilder::keep(YAML::anchor_t anchor, const YamlNode& node, std::size_t values, int height) {
  if (anchor == 0) return;
  count(values, height, node.written);  // the copy, too
  anchors_[anchor] = {node, values, height};
}

void YamlBuilder::OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) {
  YamlNode node;
  node.written = location(mark);
  count(1, 0, node.written);
  keep(anchor, node, 1, 0);
  add(std::move(node), 0);
}

void YamlBuilder::OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                           const std::string& text) {
  YamlNode node;
  node.kind = YamlNode::Kind::scalar;
  node.written = location(mark);
  node.text = text;
  node.quoted = tag == "!";
  count(1, 0, node.written);
  keep(anchor, node, 1, 0);
  add(std::move(node), 0);
}

void YamlBuilder::OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) {
  const auto known = anchors_.find(anchor);
  if (known == anchors_.end()) throw location(mark).bad("expected no alias inside of its own anchor");
  const Anchored& anchored = known->second;
  count(anchored.values, anchored.height, location(mark));
  add(anchored.node, anchored.height);
}

void YamlBuilder::OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                                  YAML::EmitterStyle::value) {
  open(YamlNode::Kind::list, mark, anchor);
}

void YamlBuilder::OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                             YAML::EmitterStyle::value) {
  open(YamlNode::Kind::map, mark, anchor);
}

void YamlBuilder::open(YamlNode::Kind kind, const YAML::Mark& mark, YAML::anchor_t anchor) {
  const Location written = location(mark);
  const std::size_t first = count_;
  count(1, 0, written);
  Open& begun = open_.emplace_back();
  begun.node.kind = kind;
  begun.node.written = written;
  begun.anchor = anchor;
  begun.first = first;
}

void YamlBuilder::close() {
  Open ended = std::move(open_.back());
  open_.pop_back();
  for (const YamlNode& value : ended.merged) merge(ended.node, value);
  keep(ended.anchor, ended.node, count_ - ended.first, ended.height);
  add(std::move(ended.node), ended.height);
}

void YamlBuilder::add_key(const YamlNode& key) {
  Open& map = open_.back();
  map.has_key = true;
  map.merges = is_merge(key);
  if (key.kind != YamlNode::Kind::scalar) {
    // The parser takes the start of a text that breaks off for a key: its own complaint, still to come, says more.
    if (!no_word_) no_word_ = key.written;
    map.node.entries.push_back({"", key.written, YamlNode{}});
    return;
  }
  if (map.merges) {
    if (!map.merged.empty()) throw key.written.bad("key '<<' is given twice: expected a list of maps");
    return;
  }
  std::vector<YamlEntry>& entries = map.node.entries;
  if (entries.size() == many_entries)
    for (const YamlEntry& entry : entries) map.keys.insert(entry.key);
  const bool is_new =
      entries.size() < many_entries ? map.node.entry(key.text) == nullptr : map.keys.insert(key.text).second;
  if (!is_new)
    throw key.written.bad("key '" + key.text + "' is given twice, first at " +
                          map.node.entry(key.text)->written.text());
  entries.push_back({key.text, key.written, YamlNode{}});
}

void YamlBuilder::add(YamlNode node, int height) {
  if (open_.empty()) {
    root_ = std::move(node);
    return;
  }
  Open& parent = open_.back();
  parent.height = std::max(parent.height, height + 1);
  if (parent.node.kind == YamlNode::Kind::list) {
    parent.node.items.push_back(std::move(node));
  } else if (!parent.has_key) {
    add_key(node);
  } else if (parent.merges) {
    parent.has_key = false;
    const Location written = node.written;
    parent.merged = node.kind == YamlNode::Kind::list ? std::move(node.items) : std::vector<YamlNode>{std::move(node)};
    for (const YamlNode& map : parent.merged)
      if (map.kind != YamlNode::Kind::map)
        throw written.bad("expected the value of '<<' to be a map, or a list of maps");
  } else {
    parent.has_key = false;
    YamlEntry& entry = parent.node.entries.back();
    // An empty value has no mark of its own; it is located at its key.
    if (node.is_null()) node.written = entry.written;
    entry.value = std::move(node);
  }
}

void FurtherDocument::OnDocumentStart(const YAML::Mark& mark) {
  begin = mark;
  empty = true;
}

void FurtherDocument::fill(const YAML::Mark& mark) {
  if (empty) begin = mark;
  empty = false;
}

}  // namespace waitpoint::scenario
