// SPDX-License-Identifier: BSD-3-Clause
#include "tools/exec/program_conditions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/number_text.hpp"
#include "tools/command/option_values.hpp"
#include "tools/exec/own_machine_rights.hpp"
#include "tools/exec/program_file.hpp"

namespace waitpoint::tools {
namespace {

using kernel::ClockKind;
using kernel::ClockOptions;

constexpr double idle_limit_s_max = 1e9, speed_max = 1e6, delay_us_max = 1e9;

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
  if (speed) all += fmt::format(" --speed {}", *speed);
  if (idle_limit) all += " --idle-limit " + to_string(Time() + *idle_limit);
  if (own_machine) all += " --own-machine";
  if (medium.loss > 0) all += fmt::format(" --loss {}", medium.loss);
  if (!delay_text.empty()) all += " --delay " + delay_text;
  return all;
}

void ConditionArguments::add_to(Command& command) {
  command.option("--clock", clock_, "CLOCK",
                 "cost of a thread's code between two calls: fixed:US, interval:US..US (drawn by the\n"
                 "seed), counted[:NS] (NS nanoseconds, 1 by default, for each basic block of a program\n"
                 "compiled with -fsanitize-coverage=trace-pc), or measured, hence not repeatable: cpu[:xFACTOR],\n"
                 "proportional[:xFACTOR] (default: no cost)");
  command.option("--call-cost", call_cost_, "NS",
                 "virtual time of a use of a primitive and of reading a clock, in nanoseconds (default: 50); more\n"
                 "lets loops that poll end after fewer rounds");
  command.option("--children", children_, "simulated|native",
                 "mode of programs that it starts (exec, posix_spawn, system, popen): simulated, in one\n"
                 "schedule with it as its forked children are, or native (default: simulated)");
  command.option("--speed", speed_, "X",
                 "with partners outside of the simulation, at sockets: virtual time is no faster than X\n"
                 "times real time; 0: it does not wait (default: 1)");
  command.option("--idle-limit", idle_limit_, "S",
                 "end the run after S seconds of virtual time in which only timers expire and no thread\n"
                 "wakes another; 0: never (default: 3600)");
  command.flag("--own-machine", own_machine_,
               "run the processes as on a machine of their own: its network is a loopback with multicast,\n"
               "its /dev/shm is empty; no other process hears them");
  command.option("--loss", loss_, "P", "lose each UDP datagram with this probability, drawn by the seed (default: 0)");
  command.option("--delay", delay_, "US",
                 "let each UDP datagram arrive after so many microseconds, or US..US, drawn by the seed\n"
                 "(default: 0)");
  command.flag("--isolate", isolate_, "make calls fail that would leave this machine (EACCES)");
  command.flag("--trap-rdtsc", trap_rdtsc_,
               "show virtual time in the time-stamp counter, one nanosecond per tick, by trapping the\n"
               "instructions that read it (some microseconds each)");
  command.flag("--strict", strict_,
               "end the run, with the name and the place, when the program uses what does not repeat;\n"
               "includes --trap-rdtsc");
  command.flag("--trap-libc", trap_library_,
               "simulate the C library's internal waits (its own locks, a FILE* on a pipe), too, by\n"
               "trapping its system calls (some microseconds each)");
}

ProgramConditions ConditionArguments::conditions(bool is_repeated) const {
  ProgramConditions conditions;
  if (!clock_.empty()) {
    conditions.clock = parse_clock(clock_);
    if (!conditions.clock)
      refuse("--clock", "fixed:US, interval:US..US, counted[:NS], cpu[:xFACTOR] or proportional[:xFACTOR]", clock_);
  }
  conditions.clock_text = clock_;
  if (!call_cost_.empty()) {
    Duration cost;
    if (!parse_block_cost(call_cost_, cost)) refuse("--call-cost", "nanoseconds from 1 to 1000000000", call_cost_);
    conditions.call_cost = cost;
  }
  conditions.isolate = isolate_;
  conditions.trap_rdtsc = trap_rdtsc_;
  conditions.trap_library = trap_library_;
  conditions.strict = strict_;
  conditions.children = children_ == "simulated";
  if (!conditions.children && children_ != "native") refuse("--children", "native or simulated", children_);
  if (!speed_.empty()) {
    double speed = 0;
    if (!parse_number(speed_, speed) || !(speed >= 0 && speed <= speed_max))
      refuse("--speed", "a number from 0 to 1e6", speed_);
    conditions.speed = speed;
  }
  if (!idle_limit_.empty()) {
    double seconds = 0;
    if (!parse_number(idle_limit_, seconds) || !(seconds >= 0 && seconds <= idle_limit_s_max))
      refuse("--idle-limit", "seconds of virtual time from 0 to 1e9", idle_limit_);
    conditions.idle_limit = Duration::from_seconds(seconds);
  }
  conditions.own_machine = own_machine_;
  if (!loss_.empty() &&
      (!parse_number(loss_, conditions.medium.loss) || !(conditions.medium.loss >= 0 && conditions.medium.loss <= 1)))
    refuse("--loss", "a probability from 0 to 1", loss_);
  if (!delay_.empty() && !parse_delay(delay_, conditions.medium))
    refuse("--delay", "microseconds from 0 to 1e9, or an interval US..US", delay_);
  conditions.delay_text = delay_;
  const bool is_measured = conditions.clock && !repeats(*conditions.clock);
  if (strict_ && !conditions.children) throw BadInput("--strict", "cannot be used together with --children native");
  if (is_measured && (is_repeated || strict_))
    refuse("--clock", "fixed:US, interval:US..US or counted[:NS], as measured clocks are not repeatable", clock_);
  return conditions;
}

std::string ConditionArguments::first_given() const {
  return !clock_.empty()            ? "--clock"
         : !speed_.empty()          ? "--speed"
         : !idle_limit_.empty()     ? "--idle-limit"
         : isolate_                 ? "--isolate"
         : own_machine_             ? "--own-machine"
         : !loss_.empty()           ? "--loss"
         : !delay_.empty()          ? "--delay"
         : trap_rdtsc_              ? "--trap-rdtsc"
         : children_ != "simulated" ? "--children"
                                    : "";
}

}  // namespace waitpoint::tools
