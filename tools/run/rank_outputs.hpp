// SPDX-License-Identifier: BSD-3-Clause
// The data that output files of a run of several ranks take from each of them: events, samples of paths, and
// the news for a recording.
#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "modules/run/experiment.hpp"
#include "tools/record/rank_recording.hpp"

namespace waitpoint::tools {

/// The data for the files. On the leader also their destination: elsewhere the functions are null.
struct RankOutputOptions {
  bool events = false, paths = false;  ///< of --events, of --trajectory
  bool picture = false;                ///< paths in the results
  bool record = false;                 ///< of --record
  std::function<void(const std::string& line)> write_event = nullptr;
  std::function<void(std::size_t robot, bridge::PathKind kind, const bridge::DatedPose& sample)> write_sample = nullptr;
  Recording* recording = nullptr;
};

class RankOutputs {
 public:
  /// On all ranks, before the run. The scenario, which is the experiment's, and the experiment must outlive this.
  RankOutputs(const scenario::Scenario& scenario, run::Experiment& experiment, RankOutputOptions options);
  ~RankOutputs();
  RankOutputs(const RankOutputs&) = delete;
  RankOutputs& operator=(const RankOutputs&) = delete;

 private:
  /// Lines of events, those of the environment from the leader. On the leader they are in the order of their times, and
  /// at one instant in that of the ranks.
  class Events final : public run::Freight, public kernel::Watch {
   public:
    Events(bool with_environment, std::function<void(const std::string&)> write);
    std::string load() override;
    void unload(std::span<const std::string> loads) override;

   private:
    struct Line {
      Time time;
      std::string text;
      friend void carry(auto& archive, Line& line) { archive(line.time, line.text); }
    };
    static void note(kernel::Watch& watch, const kernel::EventRecord& record);

    bool with_environment_;
    std::function<void(const std::string&)> write_;
    std::vector<Line> lines_;
  };

  class Paths final : public run::Freight {
   public:
    Paths(run::Experiment& experiment, decltype(RankOutputOptions::write_sample) write);
    std::string load() override;
    void unload(std::span<const std::string> loads) override;

   private:
    struct Sample {
      std::uint32_t robot = 0;
      bridge::PathKind kind{};
      bridge::DatedPose at;
      friend void carry(auto& archive, Sample& sample) {
        archive(sample.robot, sample.kind, sample.at.date, sample.at.pose);
      }
    };
    struct OfRobot final : bridge::PathSink {
      OfRobot(std::vector<Sample>& to, std::uint32_t of) : samples(to), robot(of) {}
      void add(bridge::PathKind kind, const bridge::DatedPose& at) override { samples.push_back({robot, kind, at}); }
      std::vector<Sample>& samples;
      std::uint32_t robot;
    };

    std::deque<OfRobot> robots_;
    decltype(RankOutputOptions::write_sample) write_;
    std::vector<Sample> samples_;
  };

  run::Experiment& experiment_;
  std::optional<Events> events_;
  std::optional<Paths> paths_;
  std::optional<RankRecording> recording_;
};

}  // namespace waitpoint::tools
