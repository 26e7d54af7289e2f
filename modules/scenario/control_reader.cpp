// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/control_reader.hpp"

#include "core/file_contents.hpp"
#include "modules/scenario/yaml_reader.hpp"

namespace waitpoint::scenario {

ControlScenario read_control(const YamlNode& node) {
  constexpr std::size_t bytes_max = 1 << 20;
  ControlScenario control;
  const YamlNode* rules = &node;
  if (node.kind == YamlNode::Kind::map) {
    rules = node.find("rules");
    if (rules == nullptr) throw node.written.bad("expected key 'rules' in control");
    for (const YamlEntry& entry : node.entries) {
      if (entry.key == "rules") continue;
      for (Setting& setting : flattened(entry.value, entry.key)) control.settings.push_back(std::move(setting));
    }
  }
  control.file = rules->written.resolve(read_text(*rules, "control")).string();
  control.rules = file_contents(control.file, "rules of execution control", bytes_max);
  return control;
}

}  // namespace waitpoint::scenario
