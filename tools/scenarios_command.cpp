// SPDX-License-Identifier: BSD-3-Clause
#include "tools/scenarios_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/printable_line.hpp"
#include "tools/command/installed_part.hpp"
#include "tools/output/json_document.hpp"

namespace waitpoint::tools {
namespace {

using Json = nlohmann::ordered_json;

struct Shipped {
  std::string name, description;
  std::string needs;  ///< what must be made or installed before a run; empty: nothing
  std::filesystem::path file;
};

/// Nothing for a file without robots of its own, which others include.
std::optional<Shipped> shipped(const std::filesystem::path& file) {
  constexpr std::string_view key = "description: ", note = "# Needs: ";
  Shipped found{file.stem().string(), "", "", file};
  bool can_be_run = false;
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(key)) found.description = printable_line(line.substr(key.size()));
    if (line.starts_with(note)) found.needs = printable_line(line.substr(note.size()));
    can_be_run = can_be_run || line.starts_with("robots:") || line.starts_with("play:");
  }
  return can_be_run ? std::optional(found) : std::nullopt;
}

}  // namespace

void declare(Command& command, ScenariosOptions& options) {
  command.description = "Lists the shipped scenarios, which other commands find by their names.";
  command.examples = {""};
  command.json(options.json);
}

int list_scenarios(const ScenariosOptions& options) {
  std::vector<Shipped> all;
  for (const auto& entry : std::filesystem::directory_iterator(scenarios_folder()))
    if (entry.path().extension() == ".yaml")
      if (const std::optional<Shipped> found = shipped(entry.path())) all.push_back(*found);
  std::ranges::sort(all, {}, &Shipped::name);
  std::size_t width = 0;
  for (const Shipped& scenario : all) width = std::max(width, scenario.name.size());
  std::string text;
  Json list = Json::array();
  for (const Shipped& scenario : all) {
    text += fmt::format("{:<{}}  {}{}\n", scenario.name, width, scenario.description,
                        scenario.needs.empty() ? "" : "; needs " + scenario.needs);
    Json& row = list.emplace_back(
        Json{{"name", scenario.name}, {"file", scenario.file.string()}, {"description", scenario.description}});
    if (!scenario.needs.empty()) row["needs"] = scenario.needs;
  }
  write_text(text, options.json);
  return options.json ? end_with_json("scenarios", 0, Json{{"scenarios", list}}.dump()) : 0;
}

}  // namespace waitpoint::tools
