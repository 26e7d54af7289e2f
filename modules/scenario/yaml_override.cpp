// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/yaml_override.hpp"

#include <algorithm>
#include <map>
#include <vector>

#include "core/nearest_name.hpp"
#include "core/number_text.hpp"

namespace waitpoint::scenario {
namespace {

bool all_have_names(const std::vector<YamlNode>& items) {
  return std::all_of(items.begin(), items.end(), [](const YamlNode& item) { return !name_of(item).empty(); });
}

YamlNode* element_named(YamlNode& list, std::string_view name) {
  for (YamlNode& item : list.items) {
    if (name_of(item) == name) return &item;
  }
  return nullptr;
}

std::vector<std::string> split_path(const std::string& path) {
  std::vector<std::string> steps;
  std::size_t begin = 0;
  while (true) {
    const std::size_t end = path.find('.', begin);
    steps.push_back(path.substr(begin, end - begin));
    if (end == std::string::npos) return steps;
    begin = end + 1;
  }
}

YamlNode& element(YamlNode& list, const std::string& step, const Location& option) {
  std::size_t index = 0;
  if (parse_number(step, index)) {
    if (index < list.items.size()) return list.items[index];
    throw option.bad("there is no element " + step + ": the list has " + std::to_string(list.items.size()) +
                     ", counted from 0");
  }
  if (YamlNode* item = element_named(list, step)) return *item;
  std::vector<std::string_view> names;
  for (const YamlNode& item : list.items) names.push_back(name_of(item));
  throw option.bad("the list has no element called '" + step + "'" + did_you_mean(step, names));
}

YamlNode& step_into(YamlNode& node, const std::string& step, const Location& option) {
  if (node.kind == YamlNode::Kind::list) return element(node, step, option);
  if (node.is_null()) {
    node.kind = YamlNode::Kind::map;
    node.written = option;
  }
  if (node.kind != YamlNode::Kind::map) {
    throw option.bad("expected a map or list with '" + step + "', found " + described(node));
  }
  if (YamlEntry* entry = node.entry(step)) return entry->value;
  node.entries.push_back({step, option, YamlNode{}});
  return node.entries.back().value;
}

}  // namespace

YamlNode laid_over(const YamlNode& base, const YamlNode& over) {
  YamlNode result = base;
  if (base.kind == YamlNode::Kind::map && over.kind == YamlNode::Kind::map) {
    for (const YamlEntry& entry : over.entries) {
      if (YamlEntry* below = result.entry(entry.key)) {
        below->value = laid_over(below->value, entry.value);
        below->written = entry.written;
      } else {
        result.entries.push_back(entry);
      }
    }
    return result;
  }
  const bool lists = base.kind == YamlNode::Kind::list && over.kind == YamlNode::Kind::list;
  if (lists && !over.items.empty() && all_have_names(base.items) && all_have_names(over.items)) {
    lay_elements_over(result, over);
    return result;
  }
  return over;
}

void lay_elements_over(YamlNode& base, const YamlNode& over) {
  std::map<std::string, std::size_t, std::less<>> places;
  for (std::size_t i = 0; i < base.items.size(); ++i) places.emplace(name_of(base.items[i]), i);
  for (const YamlNode& item : over.items) {
    const std::string name(name_of(item));
    const auto [same, is_new] = places.emplace(name, base.items.size());
    if (is_new || name.empty()) {
      base.items.push_back(item);
    } else {
      YamlNode& below = base.items[same->second];
      below = laid_over(below, item);
    }
  }
}

Assignment::Assignment(const std::string& text) {
  const std::string option = "--set " + text;
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) throw BadInput(option, "expected key=value");
  path = text.substr(0, equals);
  const bool empty_step = path.front() == '.' || path.back() == '.' || path.find("..") != std::string::npos;
  if (empty_step) throw BadInput(option, "expected keys joined by single dots before '='");
  value = parse_yaml(text.substr(equals + 1), option, false);
}

void assign(YamlNode& document, const Assignment& assignment) {
  const Location option = assignment.value.written;
  YamlNode* node = &document;
  for (const std::string& step : split_path(assignment.path)) node = &step_into(*node, step, option);
  *node = assignment.value;
}

}  // namespace waitpoint::scenario
