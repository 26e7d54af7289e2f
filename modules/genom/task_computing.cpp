// SPDX-License-Identifier: BSD-3-Clause
#include "modules/genom/task_computing.hpp"

#include <cmath>

#include "core/number_text.hpp"

namespace waitpoint::genom {
namespace {

struct ProcessorKeys {
  std::string processor;
  int priority = 0;

  static void fields(auto field) {
    field("processor", &ProcessorKeys::processor,
          "one of the robot's `processors`, which tasks share; without it each task has one of its own");
    field("priority", &ProcessorKeys::priority, "on a shared processor; greater is more urgent");
  }
};

using threads::ClockKind;

constexpr std::string_view kinds[] = {"fixed", "proportional", "cpu", "interval", "counted"};

ClockKind read_kind(Settings& settings, const std::string& key) {
  std::string text = "fixed";
  settings.read_one(key, text);
  for (std::size_t i = 0; i < std::size(kinds); ++i)
    if (text == kinds[i]) return static_cast<ClockKind>(i);
  settings.reject(key, "fixed, proportional, cpu, interval or counted");
}

// "x0.5" or "0.5", to a millionth.
std::int64_t read_scale(Settings& settings, const std::string& key) {
  constexpr double scale_max = 1e6;
  std::string text = "1";
  settings.read_one(key, text);
  const std::string_view digits = std::string_view(text).substr(text.starts_with('x') ? 1 : 0);
  double scale = 0;

  const bool good = parse_number(digits, scale) && scale >= 0 && scale <= scale_max;
  if (!good) settings.reject(key, "a factor from 0 to a million, such as x0.5");
  return std::llround(scale * 1e6);
}

Duration read_cost(Settings& settings, const std::string& key, double unit_s) {
  double cost = 0;
  settings.read_one(key, cost);
  if (!(cost >= 0 && cost * unit_s <= 1e9)) settings.reject(key, "a duration that is not negative, at most 1e9 s");
  return Duration::from_seconds(cost * unit_s);
}

threads::ClockOptions read_clock(Settings& settings, const std::string& key) {
  threads::ClockOptions clock;
  if (settings.has(key)) {  // its kind alone
    clock.kind = read_kind(settings, key);
    if (clock.kind == ClockKind::interval) settings.reject(key, "{kind: interval, cost_us: [least, greatest]}");
    return clock;
  }
  clock.kind = read_kind(settings, key + ".kind");
  clock.scale_millionths = read_scale(settings, key + ".scale");
  if (clock.kind == ClockKind::interval) {
    const std::string least = key + ".cost_us.0", greatest = key + ".cost_us.1";
    if (!settings.has(least) || !settings.has(greatest))
      settings.reject(settings.has(least) ? least : key + ".kind", "accompanied by cost_us: [least, greatest]");
    clock.least = read_cost(settings, least, 1e-6);
    clock.greatest = read_cost(settings, greatest, 1e-6);
    if (clock.least > clock.greatest) settings.reject(least, "the least cost, not above the greatest");
    if (clock.greatest == Duration()) settings.reject(greatest, "a positive cost");
  }
  if (clock.kind == ClockKind::counted && settings.has(key + ".block_cost_ns"))
    clock.block_cost = read_cost(settings, key + ".block_cost_ns", 1e-9);
  return clock;
}

}  // namespace

std::span<const std::string_view> clock_kinds() { return kinds; }

TaskComputing read_processor(Settings& settings, const std::string& prefix, const NameSpace& names,
                             TaskComputing defaults) {
  ProcessorKeys keys{"", defaults.priority};
  settings.read(keys, prefix);
  if (settings.has(prefix + "processor")) {
    defaults.on = names.find_processor(keys.processor);
    if (defaults.on == nullptr) settings.reject(prefix + "processor", "one of this robot's processors");
  }
  defaults.priority = keys.priority;
  return defaults;
}

TaskComputing read_computing(Settings& settings, const std::string& prefix, const NameSpace& names,
                             const TaskComputing& defaults) {
  TaskComputing computing = read_processor(settings, prefix, names, defaults);
  computing.clock = read_clock(settings, prefix + "clock");
  return computing;
}

}  // namespace waitpoint::genom
