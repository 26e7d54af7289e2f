// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command/options/time_limits.hpp"

#include "core/number_text.hpp"
#include "tools/command/option_values.hpp"

namespace waitpoint::tools {
namespace {

constexpr double speed_min = 1e-6, speed_max = 1e6;

OptionValue pace(std::optional<double>& into) {
  OptionValue value{.placeholder = "X|max"};
  value.take = [&into](const std::string& source, const std::string& text) {
    double speed = 0;
    if (text != "max" && (!parse_number(text, speed) || !(speed >= speed_min && speed <= speed_max)))
      refuse(source, "max or a number from 0.000001 to 1000000", text);
    into = speed;
  };
  return value;
}

}  // namespace

void declare_until(Command& command, std::optional<Duration>& until, const char* section) {
  command.section(section);
  command.add("--until", seconds(until), "end at virtual time S", {.usual = "the scenario's until_s"});
}

void declare_speed(Command& command, std::optional<double>& speed, bool is_rare) {
  command.add("--speed", pace(speed), "at most X simulated seconds per second",
              {.usual = "max",
               .more = "With processes outside the default is 1.",
               .is_rare = is_rare,
               .former_values = {{"0", "max"}}});
}

}  // namespace waitpoint::tools
