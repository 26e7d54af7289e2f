// SPDX-License-Identifier: BSD-3-Clause
#include "modules/ros1/launch.hpp"

#include <algorithm>
#include <limits>

#include "core/digest.hpp"
#include "core/nearest_name.hpp"
#include "modules/ros1/graph_name.hpp"

namespace waitpoint::ros1 {
namespace {

constexpr int list_levels_max = 32;

// XML-RPC has neither nulls nor integers of more than 32 bits.
void check_value(const std::string& name, const nlohmann::json& value, const Location& written, int level = 0) {
  if (level > list_levels_max) throw written.bad("expected lists of at most 32 levels in the parameter '" + name + "'");
  if (value.is_null()) throw written.bad("expected a value of the parameter '" + name + "', found null");
  if (value.is_number_unsigned() || value.is_number_integer()) {
    constexpr auto low = std::numeric_limits<std::int32_t>::min(), high = std::numeric_limits<std::int32_t>::max();
    const bool fits = value.is_number_unsigned()
                          ? value.get<std::uint64_t>() <= std::uint64_t{high}
                          : value.get<std::int64_t>() >= low && value.get<std::int64_t>() <= high;
    if (!fits)
      throw written.bad("expected the parameter '" + name + "' to be an integer of 32 bits, found " + value.dump());
  }
  if (value.is_structured())
    for (const nlohmann::json& element : value) check_value(name, element, written, level + 1);
}

[[noreturn]] void refuse_key(const std::string& key, const std::string& name, const Location& written) {
  throw written.bad("expected the name of a parameter in '" + name + "', found '" + key + "'");
}

// The index of the node that a condition of `waiting` names: of several, the one in its namespace.
std::size_t index_of(const Launch& launch, const Node& waiting, const std::string& name) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < launch.nodes.size(); ++i)
    if (launch.nodes[i].name == name) found.push_back(i);
  if (found.size() == 1) return found.front();
  for (const std::size_t i : found)
    if (launch.nodes[i].ns == waiting.ns) return i;
  std::vector<std::string_view> names;
  names.reserve(launch.nodes.size());
  for (const Node& node : launch.nodes) names.push_back(node.name);
  throw waiting.written.bad(found.empty() ? "after: the robot has no node '" + name + "'" + did_you_mean(name, names)
                                          : "after: there are several nodes '" + name +
                                                "', but none in the namespace " + waiting.ns);
}

}  // namespace

std::string Node::global_name() const { return resolved(name, ns); }

void Launch::add(Node node) {
  const std::string name = node.global_name();
  for (const Node& other : nodes)
    if (other.global_name() == name)
      throw node.written.bad("there are two nodes called '" + name + "', the first at " + other.written.text());
  nodes.push_back(std::move(node));
}

void Launch::add(const std::string& name, const nlohmann::json& value, const Location& written) {
  if (value.is_object()) {
    for (const auto& [key, element] : value.items()) {
      if (key.empty() || key == "/" || !is_graph_name("/x/" + key)) refuse_key(key, name, written);
      add(resolved(key, name), element, written);
    }
    return;
  }
  if (name == "/") throw written.bad("expected a map of parameters for the namespace '/', found one value");
  check_value(name, value, written);
  const auto inner = parameters.lower_bound(name + "/");
  if (inner != parameters.end() && inner->first.starts_with(name + "/"))
    throw written.bad("expected no parameter '" + name + "': there is '" + inner->first + "' at " +
                      inner->second.written.text());
  for (std::size_t slash = name.rfind('/'); slash != 0 && slash != name.npos; slash = name.rfind('/', slash - 1)) {
    const auto outer = parameters.find(name.substr(0, slash));
    if (outer != parameters.end())
      throw written.bad("expected no parameter '" + name + "': '" + outer->first + "' has a value, at " +
                        outer->second.written.text());
  }
  parameters[name] = {value, written};
}

void Launch::add_text(const std::string& text) {
  Digest digest(fingerprint);
  digest.add(std::string_view(text));
  fingerprint = digest.value();
}

void settle_conditions(Launch& launch) {
  std::vector<std::string> names;
  names.reserve(launch.nodes.size());
  for (Node& node : launch.nodes) {
    names.push_back(node.global_name());
    for (StartCondition& each : node.after)
      if (each.is_of_program()) each.of = launch.nodes[index_of(launch, node, each.of)].global_name();
  }
  std::vector<ConditionedStart> starts;
  starts.reserve(names.size());
  for (std::size_t i = 0; i < names.size(); ++i) starts.push_back({names[i], launch.nodes[i].after});
  check_conditions(starts, [&](std::size_t never, const StartCondition*) {
    throw launch.nodes[never].written.bad("'" + launch.nodes[never].name +
                                          "' can never start: the conditions in after form a cycle");
  });
}

}  // namespace waitpoint::ros1
