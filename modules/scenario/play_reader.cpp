// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/play_reader.hpp"

#include "core/confinement.hpp"
#include "modules/ros1/graph_name.hpp"

namespace waitpoint::scenario {
namespace {

constexpr NumberRange seconds_from_zero{0, 1e6, "a number of seconds from 0 to 1e6"};
constexpr NumberRange frequency{1e-2, 1e4, "a frequency from 0.01 to 10000 Hz"};

std::vector<std::string> read_topics(const YamlNode& list) {
  std::vector<std::string> topics;
  for (const YamlNode& item : read_list(list, "topics")) {
    const std::string name = read_text(item, "a topic");
    if (!ros1::is_graph_name(name) || name.starts_with('~'))
      throw item.written.bad("expected the name of a topic in topics, found '" + name + "'");
    topics.push_back(ros1::resolved(name, "/"));
  }
  if (topics.empty()) throw list.written.bad("expected at least one topic in topics, or no key: then all are played");
  return topics;
}

}  // namespace

PlayScenario read_play(const YamlNode& node) {
  const YamlMap map(
      node, "play",
      {"bag", "topics", "start_s", "duration_s", "rate", "delay_s", "idle_s", "end_s", "clock_hz", "hear", "outputs"});
  PlayScenario play;
  play.written = node.written;
  if (!map.has("bag")) throw node.written.bad("expected a bag in play, or the option --play BAG, found none");
  const YamlNode& bag = map.require("bag");
  play.bag_written = bag.written;
  play.bag = bag.written.resolve(read_text(bag, "bag"));
  if (!Confinement::allows(play.bag))
    throw bag.written.bad("'" + play.bag.string() + "' lies outside of the folders that --confined allows");
  if (const YamlNode* topics = map.find("topics")) {
    play.topics = read_topics(*topics);
    play.topics_written = topics->written;
  }
  const auto read_seconds = [&map](std::string_view key, Duration& value) {
    if (map.has(key)) value = Duration::from_seconds(map.number(key, seconds_from_zero));
  };
  read_seconds("start_s", play.start);
  if (map.has("duration_s")) play.duration = Duration::from_seconds(map.number("duration_s", ranges::time_constant));
  map.read("rate", play.rate, ranges::factor);
  read_seconds("delay_s", play.delay);
  read_seconds("idle_s", play.idle);
  read_seconds("end_s", play.end_most);
  map.read("clock_hz", play.clock_hz, frequency);
  map.read("hear", play.hears);
  if (const YamlNode* outputs = map.find("outputs"))
    for (const YamlNode& item : read_list(*outputs, "outputs")) play.outputs.push_back(read_text(item, "an output"));
  return play;
}

}  // namespace waitpoint::scenario
