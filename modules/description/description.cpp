// SPDX-License-Identifier: BSD-3-Clause
#include "modules/description/description.hpp"

#include <cctype>

namespace waitpoint::description {
namespace {

std::string upper(std::string text) {
  for (char& letter : text)
    if (letter >= 'a' && letter <= 'z') letter = static_cast<char>(letter - 'a' + 'A');
  return text;
}

}  // namespace

const char* name(RequestKind kind) {
  constexpr const char* names[] = {"control", "exec", "init"};
  return names[static_cast<std::size_t>(kind)];
}

const ExecTask* find_task(const Description& description, const std::string& name) {
  for (const ExecTask& task : description.tasks)
    if (task.name.text == name) return &task;
  return nullptr;
}

std::string poster_type_name(const Description& description, const Poster& poster) {
  return upper(description.name.text) + "_" + upper(poster.name.text) + "_POSTER_STR";
}

TypeRef poster_type(const Description& description, const Poster& poster) {
  std::vector<Field> fields;
  for (const Parameter& item : poster.data) fields.push_back({item.name, item.type});
  return struct_type(std::move(fields), poster_type_name(description, poster), poster.name.place);
}

std::string path_text(const Parameter& parameter) {
  std::string text;
  for (const std::string& step : parameter.path) text += (text.empty() ? "" : ".") + step;
  return text;
}

}  // namespace waitpoint::description
