// SPDX-License-Identifier: BSD-3-Clause
#include "modules/ros1/launch_element.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <vector>

#include "core/nearest_name.hpp"
#include "core/word_list.hpp"
#include "modules/ros1/parameter_text.hpp"

namespace waitpoint::ros1 {
std::string in_brackets(std::string_view element) { return "<" + std::string(element) + ">"; }

void require_known(const LaunchScope& scope, const tinyxml2::XMLElement& element, std::string_view holder,
                   std::span<const std::string_view> known) {
  const std::string_view name = element.Name();
  if (std::find(known.begin(), known.end(), name) != known.end()) return;
  const Location written{scope.file, element.GetLineNum()};
  if (name == "machine" || name == "master")
    throw written.bad("expected no " + in_brackets(name) +
                      ": all nodes of a simulation have one machine and its master");
  throw written.bad("unknown element " + in_brackets(name) + " in " + in_brackets(holder) +
                    did_you_mean_or_expected(name, known));
}

LaunchElement::LaunchElement(const tinyxml2::XMLElement& element, LaunchScope& scope, Substitution& substitution,
                             std::initializer_list<std::string_view> attributes)
    : element_(element), scope_(scope), substitution_(substitution) {
  std::vector<std::string_view> known(attributes);
  known.insert(known.end(), {"if", "unless"});
  for (const auto* each = element.FirstAttribute(); each != nullptr; each = each->Next()) {
    const std::string_view given = each->Name();
    if (std::find(known.begin(), known.end(), given) != known.end()) continue;
    throw bad("unknown attribute '" + std::string(given) + "' of " + in_brackets(name()) +
              did_you_mean_or_expected(given, known));
  }
}

std::string LaunchElement::name() const { return element_.Name(); }

Location LaunchElement::written() const { return {scope_.file, element_.GetLineNum()}; }

bool LaunchElement::applies() const {
  const std::optional<std::string> positive = find("if"), negative = find("unless");
  if (positive && negative) throw bad("expected 'if' or 'unless' in " + in_brackets(name()) + ", found both");
  if (!positive && !negative) return true;
  bool value = false;
  const std::string& text = positive ? *positive : *negative;
  if (!read_bool(text, value))
    throw bad("expected '" + std::string(positive ? "if" : "unless") + "' of " + in_brackets(name()) +
              " to be true, 1, false or 0, found '" + text + "'");
  return value == positive.has_value();
}

std::optional<std::string> LaunchElement::find(const char* attribute) const {
  const char* const text = element_.Attribute(attribute);
  if (text == nullptr) return std::nullopt;
  return substitution_.of(text, scope_, written());
}

std::string LaunchElement::require(const char* attribute) const {
  std::optional<std::string> value = find(attribute);
  if (!value || value->empty())
    throw bad("expected the attribute '" + std::string(attribute) + "' of " + in_brackets(name()) + ", found none");
  return std::move(*value);
}

bool LaunchElement::truth(const char* attribute, bool otherwise) const {
  const std::optional<std::string> text = find(attribute);
  if (!text) return otherwise;
  bool value = false;
  // 1 and 0 are good for conditions only.
  if (text->size() < 4 || !read_bool(*text, value))
    throw bad("expected '" + std::string(attribute) + "' of " + in_brackets(name()) + " to be true or false, found '" +
              *text + "'");
  return value;
}

std::size_t LaunchElement::one_of(const char* attribute, std::span<const std::string_view> words,
                                  std::size_t otherwise) const {
  const std::optional<std::string> value = find(attribute);
  if (!value) return otherwise;
  const auto found = std::find(words.begin(), words.end(), *value);
  if (found == words.end())
    throw bad("expected '" + std::string(attribute) + "' of " + in_brackets(name()) + " to be " + word_list(words) +
              ", found '" + *value + "'");
  return static_cast<std::size_t>(found - words.begin());
}

std::string LaunchElement::text_at_its_lines() const {
  std::string text;
  int line = 1;
  for (const auto* child = element_.FirstChild(); child != nullptr; child = child->NextSibling()) {
    const tinyxml2::XMLText* const part = child->ToText();
    if (part == nullptr) continue;
    const std::string_view value = part->Value();
    // The line that is known of a part is that of its first letter.
    const std::string_view blank = value.substr(0, std::min(value.find_first_not_of(" \t\r\n"), value.size()));
    const int first = part->GetLineNum() - static_cast<int>(std::count(blank.begin(), blank.end(), '\n'));
    for (; line < first; ++line) text += '\n';
    text += value;
    line += static_cast<int>(std::count(value.begin(), value.end(), '\n'));
  }
  return text;
}

}  // namespace waitpoint::ros1
