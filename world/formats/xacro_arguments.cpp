// SPDX-License-Identifier: BSD-3-Clause
#include "world/formats/xacro_arguments.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <set>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "core/nearest_name.hpp"

namespace waitpoint::world {
namespace {

bool is_name(std::string_view text) {
  const auto fits = [](char c) {
    return c == '_' || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
  };
  return !text.empty() && std::all_of(text.begin(), text.end(), fits);
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(' ');
  return first == text.npos ? "" : text.substr(first, text.find_last_not_of(' ') + 1 - first);
}

// A value as the text of an XML attribute in either kind of quotes.
std::string escaped(std::string_view value) {
  std::string text;
  for (const char c : value) {
    switch (c) {
      case '&': text += "&amp;"; break;
      case '<': text += "&lt;"; break;
      case '"': text += "&quot;"; break;
      case '\'': text += "&apos;"; break;
      default: text += c;
    }
  }
  return text;
}

// Adds the file's own values, which the given ones override. A file that is no XML has none.
void add_own_values(const std::string& contents, XacroArguments& values) {
  tinyxml2::XMLDocument document;
  if (document.Parse(contents.data(), contents.size()) != tinyxml2::XML_SUCCESS) return;
  const tinyxml2::XMLElement* root = document.RootElement();
  if (root == nullptr) return;
  for (const auto* child = root->FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
    const std::string_view kind = child->Name();
    const char* name = child->Attribute("name");
    const char* value = kind == "xacro:arg"        ? child->Attribute("default")
                        : kind == "xacro:property" ? child->Attribute("value")
                                                   : nullptr;
    if (name != nullptr && value != nullptr && std::string_view(value).find('$') == std::string_view::npos)
      values.emplace(name, value);
  }
}

}  // namespace

std::string with_xacro_arguments(const std::string& contents, const std::string& file, const XacroArguments& given,
                                 LeftOut& left_out) {
  constexpr std::string_view call = "arg ";
  XacroArguments values = given;
  if (contents.find("xacro:") != contents.npos) add_own_values(contents, values);
  std::set<std::string, std::less<>> used;
  std::string result;
  int line = 1;
  const std::string_view text = contents;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] == '\n') ++line;
    const char opening = text[at] == '$' && at + 1 < text.size() ? text[at + 1] : '\0';
    const std::size_t end = opening == '{'   ? text.find_first_of("}\n", at)
                            : opening == '(' ? text.find_first_of(")\n", at)
                                             : text.npos;
    if (end == text.npos || text[end] == '\n') {
      result += text[at];
      continue;
    }
    const std::string_view whole = text.substr(at, end + 1 - at);
    std::string_view name = trimmed(whole.substr(2, whole.size() - 3));
    if (opening == '(') name = name.starts_with(call) ? trimmed(name.substr(call.size())) : "";
    const auto value = values.find(name);
    used.emplace(name);
    if (value != values.end()) {
      result += escaped(value->second);
    } else {
      result += whole;
      left_out.add(file, line, "'" + std::string(whole) + "'",
                   is_name(name) ? "remains as it is: it has no value in the urdf's 'arguments'"
                                 : "remains as it is: expressions are the task of xacro");
    }
    at = end;
  }
  for (const auto& [name, value] : given) {
    if (used.contains(name)) continue;
    const std::vector<std::string_view> names(used.begin(), used.end());
    throw BadInput(file, "expected the argument '" + name + "' to be used" + did_you_mean(name, names));
  }
  return result;
}

}  // namespace waitpoint::world
