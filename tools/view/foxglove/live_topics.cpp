// SPDX-License-Identifier: BSD-3-Clause
#include "tools/view/foxglove/live_topics.hpp"

#include <algorithm>
#include <utility>

#include "core/error.hpp"
#include "tools/record/foxglove.hpp"

namespace waitpoint::tools::view {

/// Collects messages of topics that are wanted.
class LiveTopics::Sink final : public TopicSink {
 public:
  Topic add(const foxglove::Schema& schema, const std::string& topic) override {
    of_lines_.push_back(schema.name == foxglove::log().name);
    wanted_.push_back(false);
    asked_.push_back(false);
    news_.added.push_back({topic, schema});
    return static_cast<Topic>(wanted_.size() - 1);
  }

  bool wants(Topic topic) const override {
    switch (news_.kind) {
      case TopicNews::Kind::steps: return wanted_[topic];
      case TopicNews::Kind::current: return asked_[topic];
      case TopicNews::Kind::last: return true;
    }
    return false;
  }

  void write(Topic topic, Time time, std::string_view message) override {
    news_.messages.push_back({topic, time, std::string(message)});
  }

  void finish() override {}

  /// True if any of the wanted topics has lines of modules.
  bool set_wanted(const std::vector<Topic>& topics) {
    std::fill(wanted_.begin(), wanted_.end(), false);
    bool lines = false;
    for (const Topic topic : topics) {
      wanted_.at(topic) = true;
      lines = lines || of_lines_[topic];
    }
    return lines;
  }

  /// The following messages are of this kind.
  void begin(TopicNews::Kind kind, std::vector<Topic> asked = {}) {
    if (!news_.added.empty() || !news_.asked.empty() || !news_.messages.empty() || !news_.trouble.empty())
      ready_.push_back(std::move(news_));
    news_ = TopicNews{.kind = kind, .asked = std::move(asked)};
    std::fill(asked_.begin(), asked_.end(), false);
    for (const Topic topic : news_.asked) asked_.at(topic) = true;
  }

  void set_trouble(const std::string& text) { news_.trouble = text; }

  std::vector<TopicNews> take() {
    begin(TopicNews::Kind::steps);
    return std::exchange(ready_, {});
  }

 private:
  std::vector<bool> of_lines_, wanted_, asked_;  // by topic
  TopicNews news_;
  std::vector<TopicNews> ready_;
};

LiveTopics::LiveTopics(const scenario::Scenario& scenario, run::Experiment& experiment)
    : LiveTopics(scenario, experiment, std::make_unique<Sink>()) {}

LiveTopics::LiveTopics(const scenario::Scenario& scenario, run::Experiment& experiment, std::unique_ptr<Sink> sink)
    : scenario_(scenario),
      experiment_(experiment),
      sink_(sink.get()),
      recording_("the viewer", scenario, std::move(sink)) {}

LiveTopics::~LiveTopics() = default;

void LiveTopics::step(Time now) {
  now_ = now;
  const bool is_sample = sampling_.is_due(now);
  if (reader_ == nullptr) return;
  if (!taps_.empty()) recording_.hold(take_lines());
  recording_.add(reader_->take(now, is_sample));
}

std::vector<RobotLines> LiveTopics::take_lines() {
  std::vector<RobotLines> lines;
  lines.reserve(taps_.size());
  for (std::size_t i = 0; i < taps_.size(); ++i) lines.push_back({static_cast<std::uint32_t>(i), taps_[i].log.take()});
  return lines;
}

std::unique_ptr<NewsReader> LiveTopics::make_reader() {
  return std::make_unique<NewsReader>(scenario_, experiment_, NewsReader::Obstacles::read, NewsReader::Lines::left_out);
}

// The first news of a reader are all that there is, and later ones what is new since.
void LiveTopics::want(const std::vector<Topic>& wanted, std::vector<Topic> asked) {
  const bool lines = sink_->set_wanted(wanted);
  if (!lines) taps_.clear();
  if (lines && taps_.empty())
    for (const auto& robot : experiment_.robots()) taps_.emplace_back(*robot);
  if (wanted.empty()) reader_.reset();
  if (asked.empty()) return;
  std::unique_ptr<NewsReader> reader = make_reader();
  sink_->begin(TopicNews::Kind::current, std::move(asked));
  recording_.add(reader->take(now_, true));
  sink_->begin(TopicNews::Kind::steps);
  if (reader_ == nullptr) reader_ = std::move(reader);
}

void LiveTopics::finish(const bridge::RunResult& result) {
  if (!taps_.empty()) {
    StepNews last{.now = Time() + result.simulated};
    for (RobotLines& lines : take_lines())
      last.robots.push_back({.robot = lines.robot, .lines = std::move(lines.lines)});
    recording_.add(std::move(last));
  }
  taps_.clear();
  sink_->begin(TopicNews::Kind::last);
  recording_.add(make_reader()->take(now_, true));
  try {
    recording_.finish(result);
  } catch (const BadInput& failure) {
    sink_->set_trouble(failure.what());
  }
}

std::vector<TopicNews> LiveTopics::take() { return sink_->take(); }

}  // namespace waitpoint::tools::view
