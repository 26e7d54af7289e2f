// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/keys.hpp"

namespace waitpoint::scenario {

void KeyTable::add_row(Row row) {
  WAITPOINT_CHECK(!has(row.name), "a key is declared twice");
  rows_.push_back(std::move(row));
  names_.clear();  // the rows may have moved
  for (const Row& each : rows_) names_.push_back(each.name);
}

Json KeyTable::schema(SchemaDefinitions& definitions) const {
  return definitions.reference(name_, [this](SchemaDefinitions& made) { return whole_schema(made); });
}

Json KeyTable::whole_schema(SchemaDefinitions& definitions) const {
  Json properties = Json::object(), needed = Json::array();
  for (const Row& row : rows_) {
    Json schema = row.schema(definitions);
    const bool is_needed = row.need == Need::required && !definitions.is_partial();
    if (!is_needed) schema = or_null(std::move(schema));
    Json property = Json::object();
    const std::string_view unit = unit_of(row.name);
    if (const std::string text = row.meaning + (unit.empty() ? "" : " [" + std::string(unit) + "]"); !text.empty())
      property["description"] = text;
    if (!row.otherwise.is_null()) property["default"] = row.otherwise;
    property.update(schema);
    properties[row.name] = std::move(property);
    if (is_needed) needed.push_back(row.name);
  }
  Json schema = {{"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
  if (!needed.empty()) schema["required"] = std::move(needed);
  if (definitions.is_partial()) return schema;
  for (const SchemaMaker& also : also_) schema["allOf"].push_back(also(definitions));
  return schema;
}

SchemaMaker map_of(const KeyTable& keys) {
  return [&keys](SchemaDefinitions& definitions) { return keys.schema(definitions); };
}

SchemaMaker list_of(const KeyTable& keys) {
  return [&keys](SchemaDefinitions& definitions) { return list_schema(keys.schema(definitions)); };
}

SchemaMaker text_or(const KeyTable& keys) {
  return [&keys](SchemaDefinitions& definitions) { return any_of({text_schema(), keys.schema(definitions)}); };
}

SchemaMaker texts(std::size_t size_min) {
  return [size_min](SchemaDefinitions&) { return list_schema(text_schema(), size_min); };
}

}  // namespace waitpoint::scenario
