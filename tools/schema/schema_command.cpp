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
};
constexpr Document documents[] = {
    {"scenario", "A scenario of waitpoint", scenario::scenario_keys},
    {"robot", "A file of robot types of waitpoint", scenario::robot_types_keys},
    {"plan", "A temporal plan of waitpoint", plan::plan_keys},
    {"floor", "A floor of waitpoint, on which worlds are built", scenario::floor_keys},
};

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
  schema.update(document->keys().whole_schema(made));
  Json& definitions = schema["$defs"] = Json::object();
  for (const auto& [name, definition] : made.made()) definitions[name] = definition;
  if (kind == "scenario" || kind == "robot") {
    definitions.update(module_definitions(types, false));
    definitions.update(module_definitions(types, true));
  }
  return schema.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

int show_schema(const SchemaOptions& options, std::span<const genom::ModuleType> types) {
  write_standard_output(schema_text(options.kind, types));
  return 0;
}

}  // namespace waitpoint::tools
