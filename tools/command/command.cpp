// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command/command.hpp"

#include <algorithm>
#include <cstdlib>

#include "core/error.hpp"
#include "tools/command/option_values.hpp"

namespace waitpoint::tools {
namespace {

constexpr const char* json_option = "--json";

std::string in_words(const std::string& option) { return option == "--" ? "a program" : option; }

/// Null if the option has no variable, or that is not set or empty.
const char* text_of_environment(const Option& option) {
  if (option.details.environment == nullptr) return nullptr;
  const char* const text = std::getenv(option.details.environment);
  return text == nullptr || *text == '\0' ? nullptr : text;
}

}  // namespace

void Command::add(const std::string& name, OptionValue value, const std::string& description, OptionDetails details) {
  const bool is_argument = !name.starts_with('-');
  (is_argument ? arguments : options).push_back({name, std::move(value), description, std::move(details), section_});
}

void Command::json(bool& into) { add(json_option, flag(into), "print the result as JSON, the text to standard error"); }

bool Command::is_given(const std::string& option) const {
  if (option == "--") return !program_.empty();
  return given_.contains(option);
}

std::vector<std::string> Command::given_options() const {
  std::vector<std::string> names;
  for (const auto& [name, texts] : given_) names.push_back(name);
  return names;
}

void Command::check(const Rule& rule) const {
  if (!is_given(rule.option)) return;
  if (!rule.unless.empty() && given_.at(rule.option).back() == rule.unless) return;
  if (rule.kind == Rule::Kind::excludes) {
    const std::string end = rule.reason.empty() ? "" : ": " + rule.reason;
    for (const std::string& other : rule.others)
      if (is_given(other))
        throw BadInput(in_words(rule.option), "cannot be used together with " + in_words(other) + end);
    return;
  }
  std::string names;
  for (const std::string& other : rule.others) {
    if (is_given(other)) return;
    names += (names.empty() ? "" : " or ") + in_words(other);
  }
  throw BadInput(in_words(rule.option), "expected " + names + (rule.reason.empty() ? "" : ", " + rule.reason));
}

bool Command::has_value(const std::string& name) const {
  const auto option = std::ranges::find(options, name, &Option::name);
  return is_given(name) || (option != options.end() && text_of_environment(*option) != nullptr);
}

void Command::take_values(const Option& option) {
  if (const auto found = given_.find(option.name); found != given_.end()) {
    if (found->second.size() > 1 && !option.value.is_repeated && !option.value.is_flag)
      throw BadInput(option.name, "is given " + std::to_string(found->second.size()) + " times, expected once");
    for (const std::string& text : found->second) option.value.take(option.name, text);
  } else if (const char* const text = text_of_environment(option)) {
    option.value.take(option.details.environment, text);
  }
}

void Command::note_files(const Option& option, OptionValue::File use) {
  const auto found = given_.find(option.name);
  if (option.value.file != use || found == given_.end()) return;
  using Use = NamedFile::Use;
  for (const std::string& text : found->second)
    for (const std::string& name : option.value.files ? option.value.files(text) : std::vector{text})
      files_.push_back({option.name, name, use == OptionValue::File::written ? Use::written : Use::read});
}

void Command::take(const Given& given, std::vector<std::string> program, Invocation invocation) {
  given_ = given;
  program_ = std::move(program);
  invocation_ = std::move(invocation);
  for (const auto* declared : {&options, &arguments})
    for (const Option& option : *declared)
      if (const auto found = given_.find(option.name); found != given_.end() && !option.value.is_flag)
        for (const std::string& text : found->second)  // usually an unset variable of a script
          if (text.empty()) throw BadInput(option.name, "expected a value, found ''");
  for (const Rule& rule : rules) check(rule);
  for (const auto* declared : {&arguments, &options})
    for (const Option& option : *declared) take_values(option);
  for (const OptionValue::File use : {OptionValue::File::written, OptionValue::File::read})
    for (const auto* declared : {&options, &arguments})
      for (const Option& option : *declared) note_files(option, use);
  check_distinct(files_);
  if (is_given(json_option)) check_beside_json(files_);
  for (const std::function<void()>& step : steps_) step();
}

}  // namespace waitpoint::tools
