// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command/options/log_source.hpp"

#include <algorithm>

#include "tools/command/installed_part.hpp"
#include "tools/command/option_values.hpp"

namespace waitpoint::tools {
namespace {

OptionValue log_file(std::filesystem::path& into) {
  OptionValue value{.file = OptionValue::File::read};
  value.take = [&into](const std::string&, const std::string& text) { into = text; };
  return value;
}

OptionValue names_with_commas(std::vector<std::string>& into) {
  OptionValue value{.placeholder = "NAME,NAME,..."};
  value.take = [&into](const std::string& source, const std::string& list) {
    for (std::size_t begin = 0; begin < list.size();) {
      const std::size_t end = std::min(list.find(',', begin), list.size());
      if (end == begin) refuse(source, "names with commas between them", list);
      const std::string name = list.substr(begin, end - begin);
      if (std::ranges::find(into, name) != into.end()) refuse(source, "each name once", list);
      into.push_back(name);
      begin = end + 1;
    }
  };
  return value;
}

OptionValue scenario_of_modules(std::optional<std::filesystem::path>& into) {
  OptionValue value = read_file(into, "FILE");
  value.take = [&into](const std::string&, const std::string& text) { into = find_scenario(text); };
  value.files = [](const std::string& text) { return std::vector{find_scenario(text).string()}; };
  return value;
}

}  // namespace

void declare_log(Command& command, LogOptions& options) {
  command.add("LOG", log_file(options.log), "of CARMEN or GMapping, a ROS 1 bag or MCAP; also compressed by gzip",
              {.is_required = true});
  command.section("The log and the modules");
  command.add("--scan", text(options.choice.scan, "NAME"), "take the scans of this type of record or topic");
  command.add("--odometry", text(options.choice.odometry, "TOPIC"), "take the odometry of this topic");
  command.add("--robot", text(options.choice.robot, "NAME"),
              "take the records of this robot or host: a log of CARMEN may have several");
  command.add("--modules", names_with_commas(options.modules), "run these modules",
              {.usual = "rflex, sick, segloc and pom"});
  command.add("--scenario", scenario_of_modules(options.scenario),
              "the modules' parameters are those of the first robot of this scenario", {.usual = "the modules' own"});
  command.add("--set", texts(options.assignments, "MODULE.KEY=VALUE"),
              "override a parameter of a module; may be repeated",
              {.more = "For example:\n  segloc.points.key_travel_m=0.2"});
}

void declare_other_log(Command& command, LogOptions& options) {
  options.choice.scan_place = "--other-scan";
  options.choice.odometry_place = "--other-odometry";
  options.choice.robot_place = "--other-robot";
  command.add("OTHER", log_file(options.log), "the other log, replayed to the same modules", {.is_required = true});
  command.section("The other log");
  command.add("--other-scan", text(options.choice.scan, "NAME"), "as --scan, for the other log");
  command.add("--other-odometry", text(options.choice.odometry, "TOPIC"), "as --odometry, for the other log");
  command.add("--other-robot", text(options.choice.robot, "NAME"), "as --robot, for the other log");
}

}  // namespace waitpoint::tools
