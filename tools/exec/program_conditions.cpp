// SPDX-License-Identifier: BSD-3-Clause
#include "tools/exec/program_conditions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/number_text.hpp"
#include "tools/command/option_values.hpp"
#include "tools/command/options/time_limits.hpp"
#include "tools/exec/own_machine_rights.hpp"
#include "tools/exec/program_file.hpp"

namespace waitpoint::tools {
namespace {

using kernel::ClockKind;
using kernel::ClockOptions;

constexpr double idle_limit_s_max = 1e9, delay_us_max = 1e9;

bool parse_cost(std::string_view text, Duration& cost) {
  double us = 0;
  if (!parse_number(text, us) || !(us > 0 && us <= 1e15)) return false;
  cost = Duration::from_seconds(us * 1e-6);
  return true;
}

bool parse_interval(std::string_view text, ClockOptions& clock) {
  const std::size_t dots = text.find("..");
  return dots != std::string_view::npos && parse_cost(text.substr(0, dots), clock.least) &&
         parse_cost(text.substr(dots + 2), clock.greatest) && clock.least <= clock.greatest;
}

bool parse_block_cost(std::string_view text, Duration& cost) {
  std::int64_t ns = 0;
  if (!parse_number(text, ns) || ns < 1 || ns > 1'000'000'000) return false;
  cost = Duration::from_ns(ns);
  return true;
}

// Parses "x0.5", or the empty text.
bool parse_scale(std::string_view text, ClockOptions& clock) {
  double scale = 1;
  if (!text.empty() && (text[0] != 'x' || !parse_number(text.substr(1), scale))) return false;
  clock.scale_millionths = std::llround(scale * 1e6);
  return scale >= 0 && scale <= 1e6;
}

// Parses "200", or "100..300", in microseconds.
bool parse_delay(std::string_view text, posix::Medium& medium) {
  const auto parse = [](std::string_view number, Duration& delay) {
    double us = 0;
    const bool good = parse_number(number, us) && us >= 0 && us <= delay_us_max;
    delay = Duration::from_ns(std::llround(us * 1e3));
    return good;
  };
  const std::size_t dots = text.find("..");
  const std::string_view greatest = dots == std::string_view::npos ? text : text.substr(dots + 2);
  return parse(text.substr(0, dots), medium.delay_least) && parse(greatest, medium.delay_greatest) &&
         medium.delay_least <= medium.delay_greatest;
}

OptionValue clock_value(ProgramConditions& conditions) {
  OptionValue value{.placeholder = "CLOCK"};
  value.words = {"fixed:US", "interval:US", "counted", "cpu", "proportional"};
  value.take = [&conditions](const std::string& source, const std::string& text) {
    conditions.clock = parse_clock(text);
    if (!conditions.clock)
      refuse(source, "fixed:US, interval:US..US, counted[:NS], cpu[:xFACTOR] or proportional[:xFACTOR]", text);
    conditions.clock_text = text;
  };
  return value;
}

OptionValue call_cost_value(std::optional<Duration>& into) {
  OptionValue value{.placeholder = "NS"};
  value.take = [&into](const std::string& source, const std::string& text) {
    Duration cost;
    if (!parse_block_cost(text, cost)) refuse(source, "nanoseconds from 1 to 1000000000", text);
    into = cost;
  };
  return value;
}

OptionValue idle_limit_value(std::optional<Duration>& into) {
  OptionValue value{.placeholder = "S"};
  value.take = [&into](const std::string& source, const std::string& text) {
    double seconds = 0;
    number(seconds, 0, idle_limit_s_max, "S", "seconds of virtual time from 0 to 1e9").take(source, text);
    into = Duration::from_seconds(seconds);
  };
  return value;
}

OptionValue delay_value(ProgramConditions& conditions) {
  OptionValue value{.placeholder = "US"};
  value.take = [&conditions](const std::string& source, const std::string& text) {
    if (!parse_delay(text, conditions.medium))
      refuse(source, "microseconds from 0 to 1e9, or an interval US..US", text);
    conditions.delay_text = text;
  };
  return value;
}

}  // namespace

std::optional<ClockOptions> parse_clock(const std::string& text) {
  const std::size_t colon = std::min(text.size(), text.find(':'));
  const std::string kind = text.substr(0, colon);
  const std::string_view value = std::string_view(text).substr(std::min(text.size(), colon + 1));
  ClockOptions clock;
  bool good = false;
  if (kind == "fixed") {
    good = parse_cost(value, clock.least);
    clock.greatest = clock.least;
  } else if (kind == "interval") {
    clock.kind = ClockKind::interval;
    good = parse_interval(value, clock);
  } else if (kind == "counted") {
    clock.kind = ClockKind::counted;
    good = value.empty() || parse_block_cost(value, clock.block_cost);
  } else if (kind == "cpu" || kind == "proportional") {
    clock.kind = kind == "cpu" ? ClockKind::cpu : ClockKind::proportional;
    good = parse_scale(value, clock);
  }
  return good ? std::optional(clock) : std::nullopt;
}

bool repeats(const ClockOptions& clock) {
  return clock.kind != ClockKind::cpu && clock.kind != ClockKind::proportional;
}

void ProgramConditions::apply_to(posix::Settings& settings) const {
  settings.has_clock = clock.has_value();
  settings.clock = clock.value_or(kernel::ClockOptions());
  if (call_cost) settings.call_cost = *call_cost;
  settings.isolate = isolate;
  settings.trap_rdtsc = trap_rdtsc || strict;
  settings.strict = strict;
  settings.trap_library = trap_library;
  settings.simulates_started = children;
  if (speed) settings.speed = *speed;
  if (idle_limit) settings.idle_limit = *idle_limit;
  settings.own_machine = own_machine;
  settings.medium = medium;
}

void ProgramConditions::check(const std::vector<std::string>& programs) const {
  if (own_machine) take_rights_for_own_machine();
  if (!clock || clock->kind != kernel::ClockKind::counted) return;
  for (const std::string& program : programs)
    if (!counts_blocks(program))
      throw BadInput("--clock", "counted is for programs compiled with -fsanitize-coverage=trace-pc, which '" +
                                    program + "' is not");
}

std::string ProgramConditions::words() const {
  std::string all;
  if (clock) all += " --clock " + clock_text;
  if (call_cost) all += fmt::format(" --call-cost {}", call_cost->ns());
  if (isolate) all += " --isolate";
  if (trap_rdtsc) all += " --trap-rdtsc";
  if (trap_library) all += " --trap-libc";
  if (strict) all += " --strict";
  if (!children) all += " --children native";
  if (speed) all += *speed > 0 ? fmt::format(" --speed {}", *speed) : " --speed max";
  if (idle_limit) all += " --idle-limit " + to_string(Time() + *idle_limit);
  if (own_machine) all += " --own-machine";
  if (medium.loss > 0) all += fmt::format(" --loss {}", medium.loss);
  if (!delay_text.empty()) all += " --delay " + delay_text;
  return all;
}

void declare_conditions(Command& command, ProgramConditions& conditions, Repetition repetition) {
  command.section("Time of a program");
  command.add("--clock", clock_value(conditions), "cost of a thread's code between two calls",
              {.usual = "none",
               .more = "fixed:US, interval:US..US (drawn by the seed), counted[:NS] (NS nanoseconds, 1 by default, for "
                       "each basic block of a program compiled with -fsanitize-coverage=trace-pc), or measured, hence "
                       "not repeatable: cpu[:xFACTOR], proportional[:xFACTOR].",
               .is_rare = repetition == Repetition::needed});
  command.add("--call-cost", call_cost_value(conditions.call_cost),
              "virtual time of a use of a primitive and of reading a clock, in nanoseconds",
              {.usual = "50", .more = "More lets loops that poll end after fewer rounds.", .is_rare = true});
  declare_speed(command, conditions.speed, repetition == Repetition::needed);
  command.add("--idle-limit", idle_limit_value(conditions.idle_limit),
              "end after S seconds of virtual time in which only timers expire",
              {.usual = "3600", .more = "In them no thread wakes another; 0: no limit.", .is_rare = true});
  command.add(
      "--trap-rdtsc", flag(conditions.trap_rdtsc), "show virtual time in the time-stamp counter",
      {.more =
           "A tick is a nanosecond. Each instruction that reads the counter is trapped, which costs some microseconds.",
       .is_rare = true});
  command.section("Surroundings of a program");
  command.add("--children", word<bool>(conditions.children, {{"simulated", true}, {"native", false}}),
              "programs that it starts (exec, posix_spawn, system, popen)",
              {.usual = "simulated",
               .more = "simulated: in one schedule with it, as its forked children are.",
               .is_rare = true});
  command.add("--own-machine", flag(conditions.own_machine), "run as on a machine of its own",
              {.more = "Its network is a loopback with multicast, its /dev/shm is empty; no other process hears it.",
               .is_rare = true});
  command.add("--loss", number(conditions.medium.loss, 0, 1, "P", "a probability from 0 to 1"),
              "lose each UDP datagram with this probability, drawn by the seed", {.usual = "0", .is_rare = true});
  command.add("--delay", delay_value(conditions), "let each UDP datagram arrive US or US..US microseconds later",
              {.usual = "0", .more = "The seed draws from an interval.", .is_rare = true});
  command.add("--isolate", flag(conditions.isolate), "make calls fail that would leave this machine (EACCES)",
              {.is_rare = true});
  command.add("--strict", flag(conditions.strict), "end the run when the program uses what does not repeat",
              {.more = "The message has its name and place. --trap-rdtsc is included.", .is_rare = true});
  command.add("--trap-libc", flag(conditions.trap_library), "simulate the C library's internal waits, too",
              {.more = "These are waits for its own locks and for a FILE* on a pipe. Each of its system calls is "
                       "trapped, which costs some microseconds.",
               .is_rare = true});
  command.finally([&conditions, repetition] {
    if (conditions.strict && !conditions.children)
      throw BadInput("--strict", "cannot be used together with --children native");
    const bool is_measured = conditions.clock && !repeats(*conditions.clock);
    if (is_measured && (repetition == Repetition::needed || conditions.strict))
      refuse("--clock", "fixed:US, interval:US..US or counted[:NS], as measured clocks are not repeatable",
             conditions.clock_text);
  });
}

}  // namespace waitpoint::tools
