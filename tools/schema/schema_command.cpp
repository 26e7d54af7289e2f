// SPDX-License-Identifier: BSD-3-Clause
#include "tools/schema/schema_command.hpp"

#include <utility>
#include <vector>

#include "modules/plan/plan_keys.hpp"
#include "modules/scenario/scenario_keys.hpp"
#include "tools/command/option_values.hpp"
#include "tools/output/output_file.hpp"
#include "tools/schema/module_schemas.hpp"

namespace waitpoint::tools {
namespace {

using scenario::Json;

struct Document {
  std::string_view kind;
  const char* title;
  const scenario::KeyTable& (*keys)();
  bool is_in_scenarios = false;  ///< its schema refers to the definitions of scenarios: the file beside it
};
constexpr Document documents[] = {
    {"scenario", "A scenario of waitpoint", scenario::scenario_keys},
    {"robot", "A file of robot types of waitpoint", scenario::robot_types_keys, true},
    {"plan", "A temporal plan of waitpoint", plan::plan_keys},
    {"floor", "A floor of waitpoint, on which worlds are built", scenario::floor_keys, true},
};

/// Indented; values that fit into a line stand in one.
std::string json_text(const Json& value, std::size_t indent = 0) {
  constexpr std::size_t line_max = 120;
  if (!value.is_structured()) return value.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::vector<std::string> parts;
  std::size_t length = indent + 2;
  parts.reserve(value.size());
  for (const auto& [key, part] : value.items()) {
    parts.push_back((value.is_object() ? Json(key).dump() + ": " : "") + json_text(part, indent + 1));
    const bool has_lines = parts.back().find('\n') != std::string::npos;
    length += has_lines ? line_max : parts.back().size() + 2;
  }
  const bool fits = length <= line_max;
  const std::string margin = fits ? "" : "\n" + std::string(indent, ' ');
  std::string text;
  for (const std::string& part : parts)
    text += (text.empty() ? "" : fits ? ", " : ",") + margin + (fits ? "" : " ") + part;
  return (value.is_object() ? "{" : "[") + text + margin + (value.is_object() ? "}" : "]");
}

}  // namespace

void declare(Command& command, SchemaOptions& options) {
  command.description = "Prints the JSON Schema (2020-12) of a kind of file, for editors and validators.";
  command.examples = {"scenario > scenario.json"};
  std::vector<std::pair<std::string, std::string>> kinds;
  for (const std::string_view kind : schema_kinds) kinds.emplace_back(kind, kind);
  command.add("KIND", word(options.kind, std::move(kinds)), "scenario, robot (a file of robot types), plan or floor",
              {.usual = options.kind});
}

std::string schema_text(std::string_view kind, std::span<const genom::ModuleType> types) {
  const Document* document = documents;
  while (document->kind != kind) ++document;
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", document->title}};
  scenario::SchemaDefinitions made;
  const Json whole = document->keys().schema(made);
  if (document->is_in_scenarios) {
    schema["$ref"] = "scenario.json" + whole["$ref"].get<std::string>();
    return json_text(schema) + "\n";
  }
  schema.update(whole);
  Json& definitions = schema["$defs"] = Json::object();
  if (kind == "scenario") {
    for (const Document& part : documents)
      if (part.is_in_scenarios) part.keys().schema(made);
    definitions = module_definitions(types);
  }
  for (const auto& [name, definition] : made.made()) definitions[name] = definition;
  return json_text(schema) + "\n";
}

int show_schema(const SchemaOptions& options, std::span<const genom::ModuleType> types) {
  write_standard_output(schema_text(options.kind, types));
  return 0;
}

}  // namespace waitpoint::tools
