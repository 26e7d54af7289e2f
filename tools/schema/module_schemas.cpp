// SPDX-License-Identifier: BSD-3-Clause
#include "tools/schema/module_schemas.hpp"

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/number_text.hpp"
#include "core/occupancy_grid.hpp"
#include "modules/executive/executive.hpp"
#include "modules/genom/module.hpp"
#include "modules/genom/task_computing.hpp"

namespace waitpoint::tools {
namespace {

using genom::SettingRow;
using scenario::Json;

struct NamedBranch;

/// Rows by the parts of their keys, which are joined by dots.
struct Branch {
  const SettingRow* row = nullptr;
  std::vector<NamedBranch> parts;  // in the order in which they are read

  Branch& part(const std::string& name);
};

struct NamedBranch {
  std::string name;
  Branch branch;
};

Branch& Branch::part(const std::string& name) {
  for (NamedBranch& known : parts)
    if (known.name == name) return known.branch;
  parts.push_back({name, {}});
  return parts.back().branch;
}

Branch tree_of(const std::vector<SettingRow>& rows) {
  Branch root;
  for (const SettingRow& row : rows) {
    Branch* branch = &root;
    for (std::size_t from = 0, dot = 0; dot != std::string::npos; from = dot + 1) {
      dot = row.key.find('.', from);
      branch = &branch->part(row.key.substr(from, dot - from));
    }
    branch->row = &row;
  }
  return root;
}

Json default_of(const SettingRow& row) {
  double number = 0;
  if (row.otherwise.empty()) return nullptr;
  if (row.kind == SettingRow::Kind::truth) return row.otherwise == "true";
  if (row.kind == SettingRow::Kind::text) return row.otherwise;
  if (!parse_number(row.otherwise, number) || number < row.least || number > row.most) return nullptr;
  if (row.kind == SettingRow::Kind::integer) return static_cast<std::int64_t>(number);
  return number;
}

Json value_schema(const SettingRow& row) {
  switch (row.kind) {
    case SettingRow::Kind::truth: return scenario::truth_schema();
    case SettingRow::Kind::integer: return {{"type", "integer"}, {"minimum", row.least}, {"maximum", row.most}};
    case SettingRow::Kind::number: return {{"type", "number"}, {"minimum", row.least}, {"maximum", row.most}};
    default: return {{"type", {"string", "number", "boolean"}}};
  }
}

Json schema_of(const std::string& name, const Branch& branch);

Json properties_of(const Branch& branch) {
  Json properties = Json::object();
  for (const auto& [name, part] : branch.parts) {
    Json property = Json::object();
    if (part.row != nullptr) {
      const std::string_view unit = unit_of(name);
      const std::string text =
          std::string(part.row->description) +
          (unit.empty() ? "" : (part.row->description.empty() ? "[" : " [") + std::string(unit) + "]");
      if (!text.empty()) property["description"] = text;
      if (const Json otherwise = default_of(*part.row); !otherwise.is_null()) property["default"] = otherwise;
    }
    if (name == "clock") property["description"] = "the virtual time that its computing takes: its kind, or a map";
    property.update(scenario::or_null(schema_of(name, part)));
    properties[name] = std::move(property);
  }
  return properties;
}

Json object_of(Json properties) {
  return {{"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
}

Json schema_of(const std::string& name, const Branch& branch) {
  if (name == "clock") return {{"$ref", "#/$defs/clock"}};
  if (branch.row != nullptr && branch.row->kind == SettingRow::Kind::list) {
    Json list = scenario::list_schema(schema_of("", branch.parts.front().branch));
    list["maxItems"] = branch.row->most;
    return list;
  }
  return branch.parts.empty() ? value_schema(*branch.row) : object_of(properties_of(branch));
}

/// The properties that are read by `read(settings)`.
template <class Read>
Json properties_read_by(const Read& read) {
  genom::Settings settings = genom::Settings::describing();
  read(settings);
  return properties_of(tree_of(settings.rows()));
}

Json parameters_of(const genom::ModuleType& type) {
  genom::NameSpace names;
  const auto map = std::make_shared<const OccupancyGrid>(1, 1, 1.0, Pose{});
  genom::ModuleSetup setup{names, type.name, genom::Settings::describing(), nullptr, map};
  std::vector<SettingRow> rows;
  try {
    const std::unique_ptr<genom::Module> module = type.make(setup);
    rows = setup.settings.rows();
    for (const genom::ExecutionTask& task : module->tasks())
      if (!task.has_permanent())
        std::erase_if(rows, [&](const SettingRow& row) { return row.key == "tasks." + task.name() + ".cost_us"; });
  } catch (const BadInput&) {
    rows = setup.settings.rows();  // it needs more than settings, such as a network; those have been read
  }
  return properties_of(tree_of(rows));
}

/// The kind alone, or a map with it.
Json clock_schema() {
  Json kinds = scenario::word_schema(genom::clock_kinds()), alone = kinds;
  auto& words = alone["enum"];
  words.erase(std::remove(words.begin(), words.end(), Json("interval")), words.end());
  const Json cost = {{"type", "number"}, {"minimum", 0}, {"maximum", 1e12}};
  Json costs = scenario::list_schema(cost, 2);
  costs["maxItems"] = 2;
  const Json scale = scenario::any_of({{{"type", "number"}, {"minimum", 0}, {"maximum", 1e6}},
                                       {{"type", "string"}, {"pattern", "^x?[0-9.]+(e[-+]?[0-9]+)?$"}}});
  using scenario::described;
  using scenario::or_null;
  Json map =
      object_of({{"kind", described("how the time of a task's computing is found: docs/clocks.md", or_null(kinds))},
                 {"cost_us", described("of `interval`: [least, greatest], from which it is drawn", or_null(costs))},
                 {"block_cost_ns", described("of `counted`: of a basic block", or_null(cost))},
                 {"scale", described("factor on it, such as x0.5", or_null(scale))}});
  map["if"] = {{"properties", {{"kind", {{"const", "interval"}}}}}, {"required", {"kind"}}};
  map["then"] = scenario::needed({"cost_us"});
  map["else"] = {{"not", scenario::needed({"cost_us"})}};
  return scenario::any_of({alone, map});
}

/// The effective type is `type`: it is given, or left out and the module's name.
Json is_of_type(const std::string& type) {
  const Json word = {{"const", type}};
  return {{"anyOf",
           {{{"properties", {{"type", word}}}, {"required", {"type"}}},
            {{"properties", {{"name", word}, {"type", {{"type", "null"}}}}}, {"required", {"name"}}}}}};
}

Json own_keys_of_modules() {
  const Json name = {{"type", {"string", "number", "boolean"}}, {"pattern", "^[A-Za-z0-9_-]{1,40}$"}};
  return {
      {"name", scenario::described("of letters, digits, `_` and `-`; its posters and requests begin with it", name)},
      {"type", scenario::described("the type of module; by default its name", scenario::or_null(name))},
      {"enabled", scenario::described("`false`: it is left out", {{"type", {"boolean", "null"}}})}};
}

/// A module of any type: the parameters of its own. One that is laid over another of its name has the type of that.
void add_module_of_any_type(Json& definitions, std::span<const genom::ModuleType> types) {
  Json choices = Json::array(), of_type = Json::array();
  for (const genom::ModuleType& type : types) {
    of_type.push_back({{"if", is_of_type(type.name)}, {"then", {{"$ref", "#/$defs/module_" + type.name}}}});
    choices.push_back(is_of_type(type.name));
  }
  definitions["module"] = {
      {"type", "object"}, {"properties", own_keys_of_modules()}, {"required", {"name"}}, {"allOf", of_type}};
  definitions["complete_module"] = {{"$ref", "#/$defs/module"}, {"anyOf", choices}};
}

}  // namespace

Json module_definitions(std::span<const genom::ModuleType> types) {
  Json definitions = Json::object();
  add_module_of_any_type(definitions, types);
  Json executive = properties_read_by([](genom::Settings& settings) {
    executive::Parameters parameters;
    executive::read(settings, parameters);
    genom::read_computing(settings, "", genom::NameSpace(), {});
  });
  executive["tcl"] =
      scenario::described("a script in Tcl in place of the executive, or below a plan", {{"type", {"string", "null"}}});
  definitions["executive"] = object_of(executive);
  Json control = properties_read_by(
      [](genom::Settings& settings) { genom::read_computing(settings, "", genom::NameSpace(), {}); });
  control["rules"] = scenario::described("the file of rules", {{"type", "string"}});
  definitions["control"] = object_of(control);
  definitions["complete_control"] = {{"$ref", "#/$defs/control"}, {"required", {"rules"}}};
  for (const genom::ModuleType& type : types) {
    Json properties = own_keys_of_modules();
    properties.update(parameters_of(type));
    definitions["module_" + type.name] = object_of(properties);
  }
  definitions["clock"] = clock_schema();
  return definitions;
}

}  // namespace waitpoint::tools
