// SPDX-License-Identifier: BSD-3-Clause
#include "modules/messages/description.hpp"

#include <algorithm>
#include <boost/uuid/detail/md5.hpp>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace waitpoint::messages {
namespace {

using Json = nlohmann::ordered_json;

std::string hexadecimal_md5(const std::string& text) {
  boost::uuids::detail::md5 hash;
  hash.process_bytes(text.data(), text.size());
  boost::uuids::detail::md5::digest_type digest;
  hash.get_digest(digest);
  // Words or bytes, by the version of Boost.
  std::string sum;
  for (const auto part : digest) {
    char digits[2 * sizeof part + 1];
    std::snprintf(digits, sizeof digits, "%0*x", static_cast<int>(2 * sizeof part), static_cast<unsigned>(part));
    sum += digits;
  }
  return sum;
}

std::string definition_of_one(const Description& type) {
  std::string text;
  for (const Description::Constant& constant : type.constants)
    text += constant.type + " " + constant.name + "=" + constant.value + "\n";
  for (const Description::Field& field : type.fields) text += field.type + field.brackets + " " + field.name + "\n";
  return text;
}

/// The messages within a type, each once, in the order of their first use.
void collect_parts(const Description& type, std::vector<const Description*>& parts) {
  for (const Description::Field& field : type.fields) {
    if (!field.is_message() || std::find(parts.begin(), parts.end(), field.parts) != parts.end()) continue;
    parts.push_back(field.parts);
    collect_parts(*field.parts, parts);
  }
}

Json object_schema(const Description& type);

Json element_schema(const Description::Field& field) {
  if (field.parts != nullptr) return object_schema(*field.parts);
  if (field.type == "string") return {{"type", "string"}};
  if (field.type == "bool") return {{"type", "boolean"}};
  return {{"type", field.type.starts_with("float") ? "number" : "integer"}};
}

Json object_schema(const Description& type) {
  Json properties = Json::object();
  for (const Description::Field& field : type.fields) {
    Json schema = element_schema(field);
    if (!field.brackets.empty()) schema = Json{{"type", "array"}, {"items", std::move(schema)}};
    properties[field.name] = std::move(schema);
  }
  return {{"type", "object"}, {"properties", std::move(properties)}};
}

}  // namespace

std::string md5_sum(const Description& type) {
  std::string text;
  for (const Description::Constant& constant : type.constants)
    text += constant.type + " " + constant.name + "=" + constant.value + "\n";
  for (const Description::Field& field : type.fields)
    text += (field.is_message() ? md5_sum(*field.parts) : field.type + field.brackets) + " " + field.name + "\n";
  if (!text.empty()) text.pop_back();
  return hexadecimal_md5(text);
}

std::string ros1_definition(const Description& type) {
  std::vector<const Description*> parts;
  collect_parts(type, parts);
  std::string text = definition_of_one(type);
  for (const Description* part : parts)
    text += std::string(80, '=') + "\nMSG: " + part->name + "\n" + definition_of_one(*part);
  return text;
}

std::string json_schema(const Description& type) {
  Json schema = object_schema(type);
  schema["title"] = type.name;
  return schema.dump();
}

}  // namespace waitpoint::messages
