// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/play_reader.hpp"

#include "core/confinement.hpp"
#include "core/file_list.hpp"
#include "modules/ros1/graph_name.hpp"
#include "modules/scenario/nodes_keys.hpp"

namespace waitpoint::scenario {
namespace {

using namespace std::chrono_literals;

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

void read_bag(const YamlNode& node, PlayScenario& play) {
  play.bag_written = node.written;
  play.bag = node.written.resolve(read_text(node, "bag"));
  if (!Confinement::allows(play.bag))
    throw node.written.bad("'" + play.bag.string() + "' lies outside of the folders that --confined allows");
  FileList::add(play.bag, FileRole::read);  // by a library, when it is played
}

void read_topics_of(const YamlNode& node, PlayScenario& play) {
  play.topics = read_topics(node);
  play.topics_written = node.written;
}

Json topics_schema(SchemaDefinitions&) { return list_schema(ros_name_schema(), 1); }

}  // namespace

const Keys<PlayScenario>& play_keys() {
  using Play = PlayScenario;
  const Form<Duration> seconds = duration_form(1s, seconds_from_zero);
  static const Keys<Play> keys =
      Keys<Play>("play")
          .add("bag", read_bag, text_form().schema, "the bag; `--play` takes its place")
          .add("topics", read_topics_of, topics_schema, "those that are played; without it all")
          .add("start_s", &Play::start, seconds,
               "from this time after the bag's first message. Latched messages from before are published at the start")
          .add("duration_s", &Play::duration, optional_form(duration_form(1s, ranges::time_constant)),
               "for so long; without it to the bag's end")
          .add("rate", &Play::rate, number_form(ranges::factor), "bag time by virtual time")
          .add("delay_s", &Play::delay, seconds,
               "from when all nodes that could start have registered with the master, to the first message")
          .add("idle_s", &Play::idle, seconds,
               "the run ends when, after the last message, nothing was heard of nodes for so long")
          .add("end_s", &Play::end_most, seconds,
               "the run ends so long after the last message, though nodes still publish")
          .add("clock_hz", &Play::clock_hz, number_form(frequency),
               "of `/clock`, with `ros: {clock: true}`: the bag's time")
          .add("hear", &Play::hears, truth_form(),
               "the run subscribes to what nodes publish, for the summary and `idle_s`")
          .add("outputs", &Play::outputs, list_form(text_form(), "an output"),
               "files that nodes write, relative to the current directory, whose digests are in the summary");
  return keys;
}

PlayScenario read_play(const YamlNode& node) {
  PlayScenario play;
  play.written = node.written;
  if (node.find("bag") == nullptr && node.kind == YamlNode::Kind::map)
    throw node.written.bad("expected a bag in play, or the option --play BAG, found none");
  read_object(node, "play", play_keys(), play);
  for (const std::string& output : play.outputs) FileList::add(output, FileRole::written);
  return play;
}

}  // namespace waitpoint::scenario
