// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/report/variable_fields.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <memory>
#include <set>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "tools/command/installed_part.hpp"
#include "tools/command/shell_words.hpp"

namespace waitpoint::tools {
namespace {

constexpr int patience_s = 20;  // it reads all of a program's debugging information

/// Where a text names variables: between the quotation marks of `memory #3 "account+8, pair"`, as sync::describe()
/// writes it.
struct Names {
  std::size_t begin, end;
};

std::vector<Names> names_in(const std::string& text) {
  constexpr std::string_view memory = "memory #";
  std::vector<Names> all;
  for (std::size_t at = text.find(memory); at != std::string::npos; at = text.find(memory, at + 1)) {
    const std::size_t behind = text.find_first_not_of("0123456789", at + memory.size());
    if (behind == std::string::npos || text.compare(behind, 2, " \"") != 0) continue;
    const std::size_t begin = behind + 2, end = text.find_first_of("\"\n", begin);
    if (end != std::string::npos && text[end] == '"') all.push_back({begin, end});
  }
  return all;
}

std::vector<std::string> variables_in(const std::string& list) {
  std::vector<std::string> variables;
  for (std::size_t from = 0; from < list.size();) {
    const std::size_t end = std::min(list.find(", ", from), list.size());
    variables.push_back(list.substr(from, end - from));
    from = end + 2;
  }
  return variables;
}

std::set<std::string> variables_named(const std::string& text) {
  std::set<std::string> variables;
  for (const Names& names : names_in(text))
    for (const std::string& variable : variables_in(text.substr(names.begin, names.end - names.begin)))
      variables.insert(variable);
  return variables;
}

// "('account', 8)".
std::string as_python(const std::string& variable) {
  const std::size_t plus = variable.rfind('+');
  return "('" + variable.substr(0, plus) + "', " + (plus == std::string::npos ? "0" : variable.substr(plus + 1)) + ")";
}

/// gdb's answers, a line each; fewer if it has none.
std::vector<std::string> answers(const std::set<std::string>& variables, const std::filesystem::path& program) {
  std::string parts;
  for (const std::string& variable : variables) parts += as_python(variable) + ", ";
  const std::vector<std::string> words = {"timeout",
                                          std::to_string(patience_s),
                                          "gdb",
                                          "-batch",
                                          "-nx",
                                          "-iex",
                                          "set auto-load no",
                                          "-ex",
                                          "python parts = [" + parts + "]",
                                          "-x",
                                          find_gdb_script("variable-fields.py").string(),
                                          program.string()};
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen((quoted(words) + " 2>/dev/null </dev/null").c_str(), "r"),
                                                   pclose);
  std::vector<std::string> lines;
  std::array<char, 4096> text{};
  while (pipe != nullptr && std::fgets(text.data(), text.size(), pipe.get()) != nullptr) {
    lines.emplace_back(text.data());
    while (lines.back().ends_with('\n')) lines.back().pop_back();
  }
  return lines;
}

}  // namespace

std::string with_fields(std::string text, const std::filesystem::path& program) {
  std::set<std::string> variables = variables_named(text);
  std::erase_if(variables, [](const std::string& variable) { return variable.find('\'') != std::string::npos; });
  if (variables.empty()) return text;
  std::vector<std::string> fields;
  try {
    fields = answers(variables, program);
  } catch (const BadInput&) {
    return text;  // a part of the installation without the scripts for gdb
  }
  if (fields.size() != variables.size()) return text;
  std::map<std::string, std::string> field_of;
  auto field = fields.begin();
  for (const std::string& variable : variables) field_of[variable] = *field++;
  std::string result;
  std::size_t from = 0;
  for (const Names& names : names_in(text)) {
    result.append(text, from, names.begin - from);
    std::string list;
    for (const std::string& variable : variables_in(text.substr(names.begin, names.end - names.begin)))
      list.append(list.empty() ? "" : ", ").append(field_of[variable].empty() ? variable : field_of[variable]);
    result += list;
    from = names.end;
  }
  return result + text.substr(from);
}

}  // namespace waitpoint::tools
