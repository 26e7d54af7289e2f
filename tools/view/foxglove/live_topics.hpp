// SPDX-License-Identifier: BSD-3-Clause
// The topics of a run for viewers that subscribe to them while it goes: the messages are those of its recording, at the
// same steps of the world. Nothing is read or written of a topic that nobody wants.
//
// Who has just subscribed wants to know what there is, also of topics that change seldom: `current` messages are made
// of all values as they are, at the time of the last step.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "modules/run/experiment.hpp"
#include "tools/record/foxglove_recording.hpp"
#include "tools/record/news_reader.hpp"
#include "tools/view/foxglove/topic_news.hpp"

namespace waitpoint::tools::view {

class LiveTopics {
 public:
  using Topic = TopicSink::Topic;

  /// Before the run; the scenario and the experiment must outlive this.
  LiveTopics(const scenario::Scenario& scenario, run::Experiment& experiment);
  ~LiveTopics();

  /// After each step of the world.
  void step(Time now);
  /// Between windows of the run: from now on these topics are wanted, and what there is of those of `asked`.
  void want(const std::vector<Topic>& wanted, std::vector<Topic> asked);
  /// The run is over.
  void finish(const bridge::RunResult& result);

  /// What the viewer is to be told since the last call.
  std::vector<TopicNews> take();

 private:
  class Sink;
  /// The lines of a robot's modules, and who watched them before.
  struct Tap {
    explicit Tap(bridge::Robot& robot) : robot(robot), before(robot.watch()), log(before) { robot.set_watch(&log); }
    ~Tap() { robot.set_watch(before); }
    Tap(const Tap&) = delete;
    Tap& operator=(const Tap&) = delete;

    bridge::Robot& robot;
    genom::ModuleWatch* before;
    ModuleLog log;
  };

  LiveTopics(const scenario::Scenario& scenario, run::Experiment& experiment, std::unique_ptr<Sink> sink);
  std::unique_ptr<NewsReader> make_reader();
  std::vector<RobotLines> take_lines();

  const scenario::Scenario& scenario_;
  run::Experiment& experiment_;
  Sink* sink_;  // of the recording
  FoxgloveRecording recording_;
  Sampling sampling_;
  Time now_;                            // of the last step
  std::unique_ptr<NewsReader> reader_;  // while any topic is wanted
  std::deque<Tap> taps_;                // by robot, while topics of lines are wanted
};

}  // namespace waitpoint::tools::view
