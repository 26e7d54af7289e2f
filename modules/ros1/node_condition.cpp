// SPDX-License-Identifier: BSD-3-Clause
#include "modules/ros1/node_condition.hpp"

#include <utility>

#include "modules/ros1/graph_name.hpp"

namespace waitpoint::ros1 {

bool parse(const std::string& text, std::string_view ns, StartCondition& condition) {
  using Kind = StartCondition::Kind;
  constexpr std::pair<std::string_view, Kind> kinds[] = {{"topic:", Kind::topic}, {"service:", Kind::service}};
  for (const auto& [prefix, kind] : kinds) {
    if (!text.starts_with(prefix)) continue;
    const std::string_view name = std::string_view(text).substr(prefix.size());
    condition = {.kind = kind, .of = resolved(name, ns)};
    return is_graph_name(name) && name != "/" && !name.starts_with('~');
  }
  return parse(text, condition);
}

}  // namespace waitpoint::ros1
