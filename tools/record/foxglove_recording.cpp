// SPDX-License-Identifier: BSD-3-Clause
#include "tools/record/foxglove_recording.hpp"

#include <fmt/format.h>

#include "modules/messages/description.hpp"
#include "modules/messages/json.hpp"
#include "modules/messages/poses.hpp"
#include "tools/output/occupied_shapes.hpp"
#include "tools/record/foxglove_messages.hpp"
#include "tools/record/reading_message.hpp"

namespace waitpoint::tools {
using messages::stamp_of;

template <messages::Message M>
FoxgloveRecording::Channel<M> FoxgloveRecording::add(const std::string& topic) {
  return {file_.add(std::string(M::type_name), messages::json_schema(messages::description_of<M>()), topic)};
}

template <messages::Message M>
void FoxgloveRecording::write(Channel<M> channel, Time received, const M& message) {
  file_.write(channel.number, received, messages::encode_json(message));
}

FoxgloveRecording::FoxgloveRecording(const std::filesystem::path& path, const scenario::Scenario& scenario)
    : ViewerRecording(path, scenario),
      file_(path),
      frames_(add<foxglove::FrameTransform>("/tf")),
      world_(add<foxglove::SceneUpdate>("/world")),
      clock_(add<foxglove::Clock>("/clock")) {
  topics_.reserve(robots().size());
  for (const OfRobot& robot : robots()) add_topics(robot);
}

void FoxgloveRecording::add_topics(const OfRobot& robot) {
  const std::string space = "/" + robot.name + "/";
  Topics& of = topics_.emplace_back();
  of.odometry = add<foxglove::PoseInFrame>(space + "odometry");
  of.position = add<foxglove::PoseInFrame>(space + "position");
  of.truth = add<foxglove::PoseInFrame>(space + "truth");
  of.log = add<foxglove::Log>(space + "modules");
}

void FoxgloveRecording::write_clock() { write(clock_, now_, foxglove::Clock{stamp_of(now_)}); }

// Stamped with the time of the first message: equal worlds give equal texts.
void FoxgloveRecording::write_obstacles(const std::vector<world::Shape>& shapes) {
  write(world_, now_, scene_of(Time(), root, shapes));
}

void FoxgloveRecording::write_transform(Time date, const std::string& parent, const std::string& child,
                                        const Pose& pose, double height_m) {
  write(frames_, now_,
        foxglove::FrameTransform{
            stamp_of(date), parent, child, {pose.x, pose.y, height_m}, messages::quaternion_of(pose.heading)});
}

void FoxgloveRecording::write_pose(Channel<foxglove::PoseInFrame> channel, Time date, const Pose& pose) {
  write(channel, now_, foxglove::PoseInFrame{stamp_of(date), root, messages::pose_message(pose)});
}

void FoxgloveRecording::write_truth(const OfRobot& robot, Time date, const Pose& pose, double) {
  write_pose(topics_[robot.number].truth, date, pose);
}

void FoxgloveRecording::write_odometry(const OfRobot& robot, const posters::Odometry& odometry) {
  write_pose(topics_[robot.number].odometry, odometry.position.date, odometry.position.pose);
}

void FoxgloveRecording::write_position(const OfRobot& robot, const posters::PositionEstimate& position) {
  write_pose(topics_[robot.number].position, position.date, position.pose);
}

void FoxgloveRecording::write_reading(const AnyNewReading& any) {
  std::visit(
      [&]<class S>(const NewReading<S>& of) {
        const auto [channel, is_new] = readings_.try_emplace(of.topic);
        if constexpr (std::is_same_v<S, world::Lasers>) {
          if (is_new) channel->second = add<foxglove::LaserScan>(of.topic).number;
          write(Channel<foxglove::LaserScan>{channel->second}, now_, scan_of(of.reading, of.frame));
        } else {
          if (is_new)
            channel->second =
                file_.add("waitpoint." + std::string(S::key), reading_schema<typename S::Reading>().dump(), of.topic);
          file_.write(channel->second, now_, messages::encode_json(of.reading));
        }
      },
      any);
}

void FoxgloveRecording::write_shown(const nodes::ShownMessage& message, const std::string& frame) {
  if (message.kind == nodes::ShownMessage::Kind::grid) {
    const auto [grid, is_new] = grids_.try_emplace(message.topic);
    if (is_new) grid->second = add<foxglove::SceneUpdate>(message.topic);
    return write(grid->second, now_, scene_of(message.date, frame, occupied_shapes(message)));
  }
  const auto [poses, is_new] = poses_.try_emplace(message.topic);
  if (is_new) poses->second = add<foxglove::PosesInFrame>(message.topic);
  write(poses->second, now_, poses_of(message, frame));
}

void FoxgloveRecording::write_log(const OfRobot& robot, const ModuleLog::Line& line) {
  write(topics_[robot.number].log, now_, line_of(line.date, line.module, line.text, line.is_bad));
}

void FoxgloveRecording::close(const bridge::RunResult& result) {
  for (const bridge::RobotResult& robot : result.robots) write_goals(robot);
  if (result.outcome == bridge::Outcome::crashed) {
    const Time end = Time() + result.simulated;
    write(add<foxglove::Log>("/waitpoint"), end, line_of(end, "waitpoint", "cut off: " + result.trouble, true));
  }
  file_.finish();
}

void FoxgloveRecording::write_goals(const bridge::RobotResult& robot) {
  const Channel<foxglove::Log> goals = add<foxglove::Log>("/" + robot.name + "/goals");
  for (const bridge::GoalResult& goal : robot.goals) {
    if (goal.report.empty()) continue;
    const std::string name = goal.name.empty() ? "goal" : goal.name;
    const std::string words =
        fmt::format("{} ({:.2f}, {:.2f}): {}", name, goal.position.x, goal.position.y, goal.report);
    write(goals, goal.date, line_of(goal.date, robot.name, words, false));
  }
}

}  // namespace waitpoint::tools
