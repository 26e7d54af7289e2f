// SPDX-License-Identifier: BSD-3-Clause
#include "tools/scenarios_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "core/printable_line.hpp"
#include "tools/command/installed_part.hpp"
#include "tools/output/json_document.hpp"

namespace waitpoint::tools {
namespace {

using Json = nlohmann::ordered_json;

/// For editors, not for people.
constexpr std::string_view modeline = "# yaml-language-server:";

/// A scenario has robots of its own; other files are included.
bool can_be_run(const std::filesystem::path& file) {
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("robots:") || line.starts_with("play:")) return true;
  return false;
}

std::string first_sentence(const std::string& text) {
  const std::size_t end = std::min(text.find(". "), text.find(": "));
  std::string sentence = text.substr(0, end);
  if (sentence.ends_with('.') || sentence.ends_with(':')) sentence.pop_back();
  return sentence;
}

}  // namespace

std::string description_of(const std::filesystem::path& scenario) {
  constexpr std::string_view key = "description: ";
  std::ifstream lines(scenario);
  std::string comment;
  bool is_in_comment = true;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(key)) return line.substr(key.size());
    if (line.starts_with(modeline)) continue;
    is_in_comment = is_in_comment && line.starts_with("# ");
    if (is_in_comment) comment += (comment.empty() ? "" : " ") + line.substr(2);
  }
  return first_sentence(comment);
}

void declare(Command& command, ScenariosOptions& options) {
  command.description = "Lists the shipped scenarios, which other commands find by their names.";
  command.examples = {""};
  command.json(options.json);
}

int list_scenarios(const ScenariosOptions& options) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(scenarios_folder()))
    if (entry.path().extension() == ".yaml" && can_be_run(entry.path())) files.push_back(entry.path());
  std::ranges::sort(files);
  std::size_t width = 0;
  for (const std::filesystem::path& file : files) width = std::max(width, file.stem().string().size());
  std::string text;
  Json list = Json::array();
  for (const std::filesystem::path& file : files) {
    const std::string name = file.stem().string(), description = printable_line(description_of(file));
    text += fmt::format("{:<{}}  {}\n", name, width, description);
    list.push_back({{"name", name}, {"file", file.string()}, {"description", description}});
  }
  write_text(text, options.json);
  return options.json ? end_with_json("scenarios", 0, Json{{"scenarios", list}}.dump()) : 0;
}

}  // namespace waitpoint::tools
