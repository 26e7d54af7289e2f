// SPDX-License-Identifier: BSD-3-Clause
// The keys of a map of a scenario, declared once: the list of valid keys, the reading of their values, the schema of
// the map and its table in the documentation are made of the declaration.
//
//   const Keys<io::Medium>& medium_keys() {
//     static const Keys<io::Medium> keys = Keys<io::Medium>("medium")
//         .add("loss", &io::Medium::loss, number_form(ranges::probability), "probability that a datagram is lost");
//     return keys;
//   }
//
//   io::Medium medium;
//   read_object(node, "the medium", medium_keys(), medium);
//
// A type with declared fields (core/fields.hpp) has its keys by them: keys_of<world::Imu::Description>().
#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "core/fields.hpp"
#include "modules/scenario/form.hpp"
#include "modules/scenario/place_reader.hpp"

namespace waitpoint::scenario {

enum class Need : std::uint8_t { optional, required };

using SchemaMaker = std::function<Json(SchemaDefinitions& definitions)>;

/// The names, meanings and schemas of the keys of a map.
class KeyTable {
 public:
  struct Row {
    std::string name, meaning;
    Need need;
    SchemaMaker schema;  ///< without the meaning
    Json otherwise;      ///< the default; null: none that could be written
  };

  /// `name` of the map in the schema.
  explicit KeyTable(std::string name) : name_(std::move(name)) {}
  KeyTable(const KeyTable&) = delete;
  KeyTable(KeyTable&&) = default;

  const std::string& name() const { return name_; }
  const std::vector<Row>& rows() const { return rows_; }
  std::span<const std::string_view> names() const { return names_; }
  bool has(std::string_view key) const { return std::find(names_.begin(), names_.end(), key) != names_.end(); }
  void add_row(Row row);
  /// A key that code reads which is beside the declaration.
  KeyTable&& add(std::string_view key, SchemaMaker schema, std::string meaning, Need need = Need::optional) && {
    add_row({std::string(key), std::move(meaning), need, std::move(schema), nullptr});
    return std::move(*this);
  }
  /// All keys of another map.
  KeyTable&& add(const KeyTable& other) && {
    for (const Row& row : other.rows()) add_row(row);
    return std::move(*this);
  }
  KeyTable&& require(Json keywords) && {
    require_also(std::move(keywords));
    return std::move(*this);
  }
  /// What beside the keys themselves has to hold, as keywords of a schema; not in a part.
  void require_also(SchemaMaker keywords) { also_.push_back(std::move(keywords)); }
  void require_also(Json keywords) {
    also_.push_back([keywords](SchemaDefinitions&) { return keywords; });
  }

  /// A reference to the schema of the map.
  Json schema(SchemaDefinitions& definitions) const;
  /// The schema itself.
  Json whole_schema(SchemaDefinitions& definitions) const;

 private:
  std::string name_;
  std::vector<Row> rows_;
  std::vector<std::string_view> names_;
  std::vector<SchemaMaker> also_;
};

/// Of a map with these keys, of a list of such maps, and of one that may be a text alone: that of its first key.
SchemaMaker map_of(const KeyTable& keys);
SchemaMaker list_of(const KeyTable& keys);
SchemaMaker text_or(const KeyTable& keys);
/// Of a list of at least so many texts.
SchemaMaker texts(std::size_t size_min = 0);

template <class T>
class Keys {
 public:
  explicit Keys(std::string name) : table_(std::move(name)) {}
  Keys(const Keys&) = delete;
  Keys(Keys&&) = default;

  /// A key whose value is a member of T.
  template <class Member>
  Keys&& add(std::string_view key, Member T::*member, const Form<Member>& form, std::string meaning,
             Need need = Need::optional) && {
    add_key(key, member, form, std::move(meaning), need);
    return std::move(*this);
  }
  /// A key whose value code reads that is beside the declaration.
  Keys&& add(std::string_view key, SchemaMaker schema, std::string meaning, Need need = Need::optional) && {
    table_.add_row({std::string(key), std::move(meaning), need, std::move(schema), nullptr});
    return std::move(*this);
  }
  /// A key whose value is more than one member of T.
  Keys&& add(std::string_view key, std::function<void(const YamlNode& node, T& value)> read, SchemaMaker schema,
             std::string meaning, Need need = Need::optional) && {
    table_.add_row({std::string(key), std::move(meaning), need, std::move(schema), nullptr});
    readers_.push_back({std::string(key), need, std::move(read)});
    return std::move(*this);
  }
  /// All declared fields of T.
  Keys&& add_fields() &&;
  Keys&& require(Json keywords) && {
    table_.require_also(std::move(keywords));
    return std::move(*this);
  }

  const KeyTable& table() const { return table_; }
  /// Overwrites the members of `value` whose keys are present, in the order of the declaration.
  void read(const YamlMap& map, T& value) const {
    for (const Reader& reader : readers_) {
      const YamlNode* const node = reader.need == Need::required ? &map.require(reader.key) : map.find(reader.key);
      if (node != nullptr) reader.read(*node, value);
    }
  }

  template <class Member>
  void add_key(std::string_view key, Member T::*member, const Form<Member>& form, std::string meaning, Need need) {
    Json otherwise = form.written && need == Need::optional ? form.written(T{}.*member) : Json();
    table_.add_row({std::string(key), std::move(meaning), need, form.schema, std::move(otherwise)});
    readers_.push_back(
        {std::string(key), need, [what = std::string(key), member, read = form.read](const YamlNode& node, T& value) {
           read(node, what, value.*member);
         }});
  }

 private:
  struct Reader {
    std::string key;
    Need need;
    std::function<void(const YamlNode& node, T& value)> read;
  };

  KeyTable table_;
  std::vector<Reader> readers_;
};

/// The keys of a type with declared fields.
template <HasFields T>
const Keys<T>& keys_of() {
  static const Keys<T> keys = Keys<T>("").add_fields();
  return keys;
}

/// Reads a map that has these keys alone, over `value`; `what` names it in messages: "the medium".
template <class T>
void read_object(const YamlNode& node, std::string what, const Keys<T>& keys, T& value) {
  keys.read(YamlMap(node, std::move(what), keys.table().names()), value);
}

/// Of a map with the keys of a type with declared fields; without a title the key is the subject of messages.
template <HasFields T>
Form<T> object_form(std::string title = "") {
  return {[title](const YamlNode& node, std::string_view what, T& value) {
            read_object(node, title.empty() ? std::string(what) : title, keys_of<T>(), value);
          },
          [](SchemaDefinitions& definitions) { return keys_of<T>().table().whole_schema(definitions); }};
}

/// The form of a declared field, by its type, name and facts.
template <class Member>
Form<Member> form_of(std::string_view name, const FieldFacts& facts) {
  if constexpr (std::is_same_v<Member, double>) {
    WAITPOINT_CHECK(facts.range, "a number of a scenario is declared without its range");
    return facts.is_degrees ? degrees_form(*facts.range) : number_form(*facts.range);
  } else if constexpr (std::is_same_v<Member, Duration>) {
    return duration_form(duration_unit(name), facts.range);
  } else if constexpr (std::is_same_v<Member, bool>) {
    return truth_form();
  } else if constexpr (std::is_enum_v<Member>) {
    return word_form<Member>(facts.words);
  } else if constexpr (std::is_integral_v<Member>) {
    return count_form<Member>(facts.count.value_or(CountRange{0, std::numeric_limits<Member>::max()}));
  } else if constexpr (std::is_same_v<Member, std::string>) {
    return text_form();
  } else if constexpr (std::is_same_v<Member, Point>) {
    return point_form();
  } else if constexpr (std::is_same_v<Member, Pose>) {
    return pose_form();
  } else if constexpr (requires {
                         typename Member::value_type;
                         std::declval<Member>().has_value();
                       }) {
    return optional_form(form_of<typename Member::value_type>(name, facts));
  } else if constexpr (requires { typename Member::allocator_type; }) {
    return list_form(form_of<typename Member::value_type>(name, facts), "an element of " + std::string(name));
  } else {
    return object_form<Member>();
  }
}

template <class T>
Keys<T>&& Keys<T>::add_fields() && {
  T::fields([this]<class Member>(std::string_view name, Member T::*member, const auto&... given) {
    const FieldFacts facts = facts_of(given...);
    this->add_key(name, member, form_of<Member>(name, facts), std::string(facts.description),
                  facts.is_required ? Need::required : Need::optional);
  });
  return std::move(*this);
}

}  // namespace waitpoint::scenario
