// SPDX-License-Identifier: BSD-3-Clause
#include "modules/ros1/substitution.hpp"

#include <algorithm>
#include <filesystem>
#include <vector>

#include "core/nearest_name.hpp"
#include "modules/ros1/graph_name.hpp"
#include "modules/ros1/launch_expression.hpp"

namespace waitpoint::ros1 {
namespace {

constexpr std::size_t substituted_bytes_max = 1 << 20, all_substituted_bytes_max = std::size_t{64} << 20;

constexpr std::string_view calls[] = {"arg", "find", "env", "optenv", "anon", "dirname", "eval"};

std::vector<std::string> words_of(std::string_view call) {
  std::vector<std::string> words;
  for (std::size_t at = 0; at < call.size();) {
    const std::size_t end = std::min(call.find_first_of(" \t\r\n", at), call.size());
    if (end > at) words.emplace_back(call.substr(at, end - at));
    at = end + 1;
  }
  return words;
}

std::string in_call(const std::vector<std::string>& words) {
  std::string text = "$(";
  for (const std::string& word : words) text += (text.size() > 2 ? " " : "") + word;
  return text + ")";
}

void expect_operands(const std::vector<std::string>& words, std::size_t least, std::size_t most,
                     std::string_view expected, const Location& written) {
  if (words.size() - 1 < least || words.size() - 1 > most)
    throw written.bad("expected " + std::string(expected) + ", found '" + in_call(words) + "'");
}

}  // namespace

std::string Substitution::value_of_argument(const std::string& name, const LaunchScope& scope,
                                            const Location& written) const {
  if (const auto found = scope.arguments.find(name); found != scope.arguments.end()) return found->second;
  if (scope.declared.contains(name)) throw written.bad("expected a value of the argument '" + name + "', found none");
  std::vector<std::string_view> names;
  names.reserve(scope.arguments.size());
  for (const auto& [known, value] : scope.arguments) names.push_back(known);
  throw written.bad("there is no argument '" + name + "' here" + did_you_mean(name, names));
}

std::string Substitution::value_of_call(const std::vector<std::string>& words, LaunchScope& scope,
                                        const Location& written) {
  const std::string& call = words.front();
  if (call == "arg") {
    expect_operands(words, 1, 1, "$(arg NAME)", written);
    return value_of_argument(words[1], scope, written);
  }
  if (call == "find") {
    expect_operands(words, 1, 1, "$(find PACKAGE)", written);
    if (const auto folder = surroundings_.packages.folder(words[1])) return folder->string();
    std::string roots;
    for (const std::filesystem::path& root : surroundings_.packages.roots())
      roots += (roots.empty() ? "" : ", ") + root.string();
    throw written.bad("there is no package '" + words[1] + "' in " + roots);
  }
  if (call == "env") {
    expect_operands(words, 1, 1, "$(env NAME)", written);
    if (const auto value = surroundings_.environment(words[1])) return *value;
    throw written.bad("expected the variable '" + words[1] + "' in the environment, found none");
  }
  if (call == "optenv") {
    expect_operands(words, 1, words.size(), "$(optenv NAME DEFAULT)", written);
    if (const auto value = surroundings_.environment(words[1])) return *value;
    std::string otherwise;
    for (std::size_t i = 2; i < words.size(); ++i) otherwise += (i > 2 ? " " : "") + words[i];
    return otherwise;
  }
  if (call == "anon") {
    expect_operands(words, 1, 1, "$(anon WORD)", written);
    if (!is_base_name(words[1])) throw written.bad("expected $(anon WORD) with a name, found '" + words[1] + "'");
    std::string& name = scope.anonymous[words[1]];
    if (name.empty()) name = words[1] + "_" + std::to_string(++anonymous_names_);
    return name;
  }
  if (call == "dirname") {
    expect_operands(words, 0, 0, "$(dirname)", written);
    return std::filesystem::absolute(scope.file.text()).parent_path().lexically_normal().string();
  }
  if (call == "eval") throw written.bad("expected $(eval ...) to be the whole text, found a text around it");
  const std::string hint = did_you_mean(call, calls);
  throw written.bad("unknown substitution '" + in_call(words) + "'" +
                    (hint.empty() ? ", expected arg, find, env, optenv, anon, dirname or eval" : hint));
}

std::string Substitution::counted(std::string text, const Location& written) {
  bytes_ += text.size();
  if (bytes_ > all_substituted_bytes_max)
    throw written.bad("expected texts of at most 64 MiB together after substitution");
  return text;
}

std::string Substitution::of(std::string_view text, LaunchScope& scope, const Location& written) {
  constexpr std::string_view evaluation = "$(eval ";
  if (text.starts_with(evaluation) && text.ends_with(')')) {
    const std::string_view expression = text.substr(evaluation.size(), text.size() - evaluation.size() - 1);
    const auto call = [&](const std::vector<std::string>& words) { return value_of_call(words, scope, written); };
    return counted(value_of_expression(expression, call, written), written);
  }
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t begin = text.find("$(", at);
    result += text.substr(at, begin - at);
    if (begin == text.npos) break;
    const std::size_t end = text.find_first_of("()$", begin + 2);
    if (end == text.npos || text[end] != ')')
      throw written.bad("expected a ')' after '" + std::string(text.substr(begin, end - begin)) + "'");
    const std::vector<std::string> words = words_of(text.substr(begin + 2, end - begin - 2));
    if (words.empty()) throw written.bad("expected a substitution such as $(arg NAME), found '$()'");
    result += value_of_call(words, scope, written);
    at = end + 1;
    if (result.size() > substituted_bytes_max) throw written.bad("expected a text of at most 1 MiB after substitution");
  }
  return counted(std::move(result), written);
}

}  // namespace waitpoint::ros1
