// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command/options/scenario.hpp"

#include "tools/command/installed_part.hpp"
#include "tools/command/option_values.hpp"

namespace waitpoint::tools {
namespace {

OptionValue scenario_file(std::filesystem::path& into) {
  OptionValue value{.file = OptionValue::File::read};
  value.take = [&into](const std::string&, const std::string& text) { into = find_scenario(text); };
  value.files = [](const std::string& text) { return std::vector{find_scenario(text).string()}; };
  return value;
}

namespace fs = std::filesystem;

fs::path folder_of(const std::string& file) {
  std::error_code error;
  return fs::weakly_canonical(fs::absolute(file, error), error).parent_path();
}

/// The folders in which an option's file or socket is made: of outputs, and of addresses "unix:PATH".
void add_writable(const Command& command, std::vector<fs::path>& writable) {
  for (const NamedFile& file : command.files()) {
    const fs::file_type type = fs::status(file.name).type();
    const bool is_made = type == fs::file_type::regular || type == fs::file_type::not_found;
    if (file.use == NamedFile::Use::written && is_made && file.name != "-") writable.push_back(folder_of(file.name));
  }
  constexpr std::string_view scheme = "unix:";
  for (const char* const option : {"--external", "--serve-world"}) {
    for (const std::string& address : command.texts(option))
      if (const std::size_t at = address.find(scheme); at != address.npos)
        writable.push_back(folder_of(address.substr(at + scheme.size(), address.find(' ', at) - at - scheme.size())));
  }
  std::error_code error;
  if (command.is_given("--verify")) writable.push_back(fs::temp_directory_path(error));
}

void prepare_system(const Command& command, ScenarioOptions& options) {
  SystemConfinement& system = options.system;
  system.folders = options.confined_to;
  for (const NamedFile& file : command.files())
    if (file.use == NamedFile::Use::read) system.inputs.emplace_back(file.name);
  if (command.is_given("--replay")) system.inputs.emplace_back(command.text("--replay"));  // a token or a file
  add_writable(command, system.writable);
  for (const char* const option : {"--external", "--serve-world", "--serve"})
    system.uses_network = system.uses_network || command.is_given(option);
}

/// The scenario's own folder, then those of --allow.
void confine(const Command& command, ScenarioOptions& options) {
  if (!options.is_confined) return;
  options.confined_to = {options.scenario.has_parent_path() ? options.scenario.parent_path() : "."};
  options.confined_to.insert(options.confined_to.end(), options.allowed.begin(), options.allowed.end());
  prepare_system(command, options);
}

}  // namespace

void declare_scenario(Command& command, ScenarioOptions& options, ScenarioArgument argument) {
  command.add("SCENARIO", scenario_file(options.scenario),
              "its file, or the name of a shipped one (waitpoint scenarios)",
              {.is_required = argument == ScenarioArgument::required});
  command.section("Scenario");
  command.add("--set", texts(options.assignments, "KEY=VALUE"), "override a value of the scenario; may be repeated",
              {.more = "KEY is keys joined by dots, elements of lists by their index from 0 or their name; VALUE is "
                       "YAML. A file named here is relative to the current directory. For example:\n"
                       "  robots.0.goals=[[1,2],[3,4]]\n"
                       "  robot_types.rackham.modules.segloc.enabled=false"});
  command.add("--confined", flag(options.is_confined),
              "for a stranger's scenario: files in its own folder and below it alone, and no programs (docs/trust.md)",
              {.is_rare = true});
  command.add("--allow", texts(options.allowed, "FOLDER"),
              "files of FOLDER, too: for scripts, and with --confined for all; may be repeated", {.is_rare = true});
  command.finally([&command, &options] { confine(command, options); });
}

}  // namespace waitpoint::tools
