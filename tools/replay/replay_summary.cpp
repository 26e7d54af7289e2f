// SPDX-License-Identifier: BSD-3-Clause
#include "tools/replay/replay_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

#include "core/exact_math.hpp"
#include "core/number_text.hpp"
#include "core/printable_line.hpp"

namespace waitpoint::tools {
namespace {

double length_m(const std::vector<playback::StampedPose>& trajectory) {
  double sum = 0;
  for (std::size_t i = 1; i < trajectory.size(); ++i)
    sum += length(trajectory[i].pose.position() - trajectory[i - 1].pose.position());
  return sum;
}

std::string line(const char* name, const std::string& text) { return fmt::format("  {:<18}{}\n", name, text); }

std::string errors_text(const RelationErrors& errors) {
  constexpr double degree = exact::pi / 180;
  if (errors.used == 0)
    return fmt::format("0 of {}: -{}", errors.given, errors.given > 0 ? " (none has poses at both of its stamps)" : "");
  return fmt::format("{} of {}: {:.3f} m +- {:.3f}, {:.2f} deg +- {:.2f}", errors.used, errors.given,
                     errors.translation_m.mean, errors.translation_m.deviation, errors.rotation_rad.mean / degree,
                     errors.rotation_rad.deviation / degree);
}

/// The most frequent types or topics, and how many others there are.
std::string left_out_text(const std::map<std::string, std::uint64_t>& left_out) {
  constexpr std::size_t named_max = 8;
  std::vector<std::pair<std::string, std::uint64_t>> kinds(left_out.begin(), left_out.end());
  std::stable_sort(kinds.begin(), kinds.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  std::vector<std::string> parts;
  for (const auto& [kind, count] : std::span(kinds).first(std::min(named_max, kinds.size())))
    parts.push_back(fmt::format("{} {}", count, kind));
  if (kinds.size() > named_max) parts.push_back(counted(kinds.size() - named_max, "other kind"));
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string stamps_text(const logs::PlayingOrder& order) {
  std::vector<std::string> parts;
  if (order.late > 0) parts.push_back(fmt::format("{} written late", order.late));
  if (order.equal > 0) parts.push_back(fmt::format("{} not after the one before", order.equal));
  if (order.clock_set > 0) parts.push_back("the clock set " + counted(order.clock_set, "time"));
  return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace

std::string replay_text(const logs::SensorLog& log, const playback::Playback& playback, const ReplayResult& result) {
  std::string text = fmt::format("{}: {} after {:.1f} s of the log\n\n", printable_line(log.file), result.outcome,
                                 result.simulated.seconds());
  text += line("scans", fmt::format("{} of {} ({}), at most {:.3f} s after their dates", playback.player().scans(),
                                    log.scans.size(), log.laser, playback.player().greatest_delay().seconds()));
  if (const std::string stamps = stamps_text(playback.order()); !stamps.empty()) text += line("stamps", stamps);
  if (!log.left_out.empty()) text += line("left out", left_out_text(log.left_out));
  text += line("trajectory", fmt::format("{} of {}, {:.1f} m", counted(result.trajectory.size(), "pose"),
                                         result.pose_source, length_m(result.trajectory)));
  if (!result.relations.empty()) {
    using namespace std::chrono_literals;
    text += line("relations", errors_text(relation_errors(result.relations, result.trajectory)));
    text += line("within 20 s", errors_text(relation_errors(result.relations, result.trajectory, 20s)));
  }
  text += line("events", fmt::format("{}", result.events));
  text += line("speed", fmt::format("{:.1f} times real time ({:.2f} s)",
                                    result.wall_s > 0 ? result.simulated.seconds() / result.wall_s : 0, result.wall_s));
  return text + "\n" + line("digest", to_string(result.digest));
}

std::string replay_json(const logs::SensorLog& log, const playback::Playback& playback, const ReplayResult& result) {
  nlohmann::ordered_json object;
  object["log"] = log.file;
  object["format"] = log.format;
  object["laser"] = log.laser;
  object["outcome"] = result.outcome;
  object["simulated_s"] = result.simulated.seconds();
  object["scans"] = playback.player().scans();
  object["scans_of_log"] = log.scans.size();
  object["scan_delay_max_s"] = playback.player().greatest_delay().seconds();
  object["stamps_late"] = playback.order().late;
  object["stamps_equal"] = playback.order().equal;
  object["clock_set"] = playback.order().clock_set;
  object["left_out"] = log.left_out;
  object["pose"] = result.pose_source;
  object["poses"] = result.trajectory.size();
  object["trajectory_m"] = length_m(result.trajectory);
  if (!result.relations.empty())
    object["relations"] = nlohmann::ordered_json::parse(relations_json(result.relations, result.trajectory));
  object["events"] = result.events;
  object["wall_s"] = result.wall_s;
  object["digest"] = to_string(result.digest);
  // Of a file's name, bytes that are no UTF-8 are replaced.
  return object.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace waitpoint::tools
