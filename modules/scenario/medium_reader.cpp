// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/medium_reader.hpp"

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

Json latency_schema(SchemaDefinitions&) {
  return any_of({number_schema(latency_range), numbers_schema(latency_range, 2, 2)});
}

}  // namespace

const Keys<io::Medium>& medium_keys() {
  using io::Medium;
  constexpr NumberRange per_metre{0, 1e6, "a number from 0 to 1000000"};
  constexpr NumberRange range{1e-3, 1e9, "a number of metres from 0.001 to 1e9"};
  static const Keys<Medium> keys =
      Keys<Medium>("medium")
          .add("latency_ms", read_latency, latency_schema,
               "of each message: a positive number, or `[least, greatest]`, from which it is drawn", Need::required)
          .add("latency_us_per_m", &Medium::latency_per_metre, duration_form(1us, per_metre),
               "added for each metre between the two robots")
          .add("bandwidth_bit_s", &Medium::bandwidth_bit_s, count_form<std::uint64_t>({1, 1'000'000'000'000}),
               "from each robot to each other one; messages queue")
          .add("queue_bytes", &Medium::queue_bytes, count_form<std::uint64_t>({0, 1'000'000'000}),
               "queue limit: datagrams beyond it are dropped")
          .add("range_m", &Medium::range_m, number_form(range),
               "out of range datagrams are lost; streams and letters wait until the robots are nearer")
          .add("range_check_ms", &Medium::range_check, duration_form(1ms),
               "period at which waiting messages check the range")
          .add("loss", &Medium::loss, number_form(ranges::probability),
               "probability that a datagram is lost; streams and letters are never lost");
  return keys;
}

io::Medium read_medium(const YamlNode& node) {
  io::Medium medium;
  read_object(node, "the medium", medium_keys(), medium);
  return medium;
}

}  // namespace waitpoint::scenario
