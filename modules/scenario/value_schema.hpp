// SPDX-License-Identifier: BSD-3-Clause
// JSON Schemas (2020-12) of the values that yaml_reader.hpp reads: each accepts what the function of the same name
// does, but for numbers nearer to 0 than 1e-12.
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>

#include "core/number_range.hpp"
#include "core/time.hpp"

namespace waitpoint::scenario {

using Json = nlohmann::ordered_json;

/// The parts of a schema that other parts refer to by their names: `shape` has the keys of a shape, `complete_shape`
/// refers to it and has what a shape needs that is not laid over another one, if it needs anything.
class SchemaDefinitions {
 public:
  /// A partial one is of what is laid over other values: it requires no keys.
  explicit SchemaDefinitions(bool is_partial = false) : is_partial_(is_partial) {}

  bool is_partial() const { return is_partial_; }
  /// A reference to the definition `name`, which `make` makes at first use.
  Json reference(const std::string& name, const std::function<Json(SchemaDefinitions&)>& make);
  /// The schema of a part, or of a whole within a part: what replaces a value as a whole.
  Json part(const std::function<Json(SchemaDefinitions&)>& make);
  Json whole(const std::function<Json(SchemaDefinitions&)>& make);
  const std::map<std::string, Json>& made() const { return made_; }

 private:
  Json made_by(bool is_partial, const std::function<Json(SchemaDefinitions&)>& make);

  bool is_partial_;
  std::map<std::string, Json> made_;
  std::map<std::string, std::string> complete_;  // the name of the complete definition by that of its keys
};

Json number_schema(const NumberRange& range);
Json duration_schema(Duration unit);
Json count_schema(const CountRange& range);
Json truth_schema();
/// A text may be written as a number or a word that is one to others.
Json text_schema();
Json word_schema(std::span<const std::string_view> words);
Json list_schema(Json item, std::size_t size_min = 0);
/// A list of `size_min` to `size_max` numbers.
Json numbers_schema(const NumberRange& range, std::size_t size_min, std::size_t size_max);
/// A map of any keys, whose values are each of this kind.
Json map_schema(Json value);
Json any_of(std::initializer_list<Json> schemas);
/// The same with a text about it.
Json described(std::string_view text, const Json& schema);
/// The keys are there, with values.
Json needed(std::initializer_list<const char*> keys);
/// The same or null: a key without a value is the same as no key.
Json or_null(Json schema);

}  // namespace waitpoint::scenario
