// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/medium_reader.hpp"

#include "modules/scenario/yaml_reader.hpp"

namespace waitpoint::scenario {
namespace {

using namespace std::chrono_literals;

// A nanosecond to an hour. Zero is not allowed: a robot must not affect another at the same instant.
constexpr NumberRange latency_range{1e-6, 3.6e6, "a positive number of at most 3600000"};

Duration milliseconds(double number) { return Duration::from_seconds(number * 1e-3); }

// `latency_ms: 2` or `latency_ms: [1, 5]`.
void read_latency(const YamlNode& node, io::Medium& medium) {
  if (node.kind != YamlNode::Kind::list) {
    medium.latency_least = medium.latency_most = milliseconds(read_number(node, "latency_ms", latency_range));
    return;
  }
  const std::vector<double> ends = read_numbers(node, "latency_ms", 2, 2, latency_range);
  if (ends[0] > ends[1]) throw node.written.bad("expected latency_ms to be [least, greatest]");
  medium.latency_least = milliseconds(ends[0]);
  medium.latency_most = milliseconds(ends[1]);
}

}  // namespace

io::Medium read_medium(const YamlNode& node) {
  const YamlMap map(
      node, "the medium",
      {"latency_ms", "latency_us_per_m", "bandwidth_bit_s", "queue_bytes", "range_m", "range_check_ms", "loss"});
  io::Medium medium;
  read_latency(map.require("latency_ms"), medium);
  constexpr NumberRange per_metre_range{0, 1e6, "a number from 0 to 1000000"};
  double latency_us_per_m = 0;
  map.read("latency_us_per_m", latency_us_per_m, per_metre_range);
  medium.latency_per_metre = Duration::from_seconds(latency_us_per_m * 1e-6);
  map.read("bandwidth_bit_s", medium.bandwidth_bit_s, 1, 1'000'000'000'000);
  map.read("queue_bytes", medium.queue_bytes, 0, 1'000'000'000);
  constexpr NumberRange range{1e-3, 1e9, "a number of metres from 0.001 to 1e9"};
  map.read("range_m", medium.range_m, range);
  map.read("range_check_ms", medium.range_check, 1ms);
  map.read("loss", medium.loss, {0, 1, "a probability from 0 to 1"});
  return medium;
}

}  // namespace waitpoint::scenario
