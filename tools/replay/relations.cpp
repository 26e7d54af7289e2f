// SPDX-License-Identifier: BSD-3-Clause
#include "tools/replay/relations.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "core/error.hpp"
#include "core/file_contents.hpp"
#include "core/number_text.hpp"
#include "core/printable_line.hpp"
#include "modules/logs/stamp.hpp"

namespace waitpoint::tools {
namespace {

using namespace std::chrono_literals;
using playback::StampedPose;

constexpr double value_most = 1e6;  // metres and radians
constexpr Duration apart_most = 1s, off_most = 100ms;

Duration apart(Time a, Time b) { return a < b ? b - a : a - b; }

std::optional<Pose> pose_at(const std::vector<StampedPose>& trajectory, Time stamp) {
  const auto after = std::lower_bound(trajectory.begin(), trajectory.end(), stamp,
                                      [](const StampedPose& pose, Time t) { return pose.stamp < t; });
  if (after != trajectory.end() && after->stamp == stamp) return after->pose;
  const bool has_before = after != trajectory.begin(), has_after = after != trajectory.end();
  if (has_before && has_after && after->stamp - (after - 1)->stamp <= apart_most) {
    const StampedPose& before = *(after - 1);
    const double fraction =
        static_cast<double>((stamp - before.stamp).ns()) / static_cast<double>((after->stamp - before.stamp).ns());
    return interpolate(before.pose, after->pose, fraction);
  }
  if (has_before && stamp - (after - 1)->stamp <= off_most) return (after - 1)->pose;
  if (has_after && after->stamp - stamp <= off_most) return after->pose;
  return std::nullopt;
}

Moments moments(const std::vector<double>& values) {
  Moments result;
  if (values.empty()) return result;
  const auto count = static_cast<double>(values.size());
  for (const double value : values) result.mean += value / count;
  for (const double value : values) result.deviation += exact::square(value - result.mean) / count;
  result.deviation = std::sqrt(result.deviation);
  return result;
}

std::vector<double> squares(std::vector<double> values) {
  for (double& value : values) value *= value;
  return values;
}

Relation read_relation(const std::string& file, int number, std::istringstream& words) {
  const auto bad = [&](const char* expected, const std::string& found) {
    return BadInput(file, number,
                    std::string("expected ") + expected + ", found " +
                        (found.empty() ? "the end of the line" : "'" + printable_line(found) + "'"));
  };
  std::array<Time, 2> stamps;
  std::string word;
  for (Time& stamp : stamps) {
    word.clear();
    words >> word;
    const std::optional<Time> read = logs::parse_stamp(word);
    if (!read) throw bad("a relation: stamp1 stamp2 x y z roll pitch yaw", word);
    stamp = *read;
  }
  std::array<double, 6> values{};
  for (double& value : values) {
    word.clear();
    words >> word;
    if (!parse_number(word, value) || !(std::fabs(value) <= value_most))
      throw bad("a number of the relation's x y z roll pitch yaw, at most 1000000", word);
  }
  word.clear();
  words >> word;
  if (!word.empty()) throw bad("the end of the line after a relation's eight numbers", word);
  return {stamps[0], stamps[1], {values[0], values[1], exact::wrap_angle(values[5])}};
}

nlohmann::ordered_json json(const RelationErrors& errors) {
  nlohmann::ordered_json object;
  object["relations"] = errors.used;
  object["relations_given"] = errors.given;
  const auto of_used = [&](double value) {
    return errors.used > 0 ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
  };
  const auto add = [&](const char* name, const char* unit, const Moments& of) {
    object[std::string(name) + "_mean_" + unit] = of_used(of.mean);
    object[std::string(name) + "_deviation_" + unit] = of_used(of.deviation);
  };
  add("translation", "m", errors.translation_m);
  add("rotation", "rad", errors.rotation_rad);
  add("squared_translation", "m2", errors.squared_translation_m2);
  add("squared_rotation", "rad2", errors.squared_rotation_rad2);
  return object;
}

}  // namespace

std::vector<Relation> read_relations(const std::filesystem::path& file) {
  constexpr std::size_t bytes_max = std::size_t{1} << 30;
  std::istringstream text(given_file_contents(file, bytes_max));
  std::vector<Relation> relations;
  int number = 0;
  for (std::string line; std::getline(text, line);) {
    ++number;
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first == line.npos || line[first] == '#') continue;
    std::istringstream words(line);
    relations.push_back(read_relation(file.string(), number, words));
  }
  if (relations.empty()) throw BadInput(file.string(), "expected relations: stamp1 stamp2 x y z roll pitch yaw");
  return relations;
}

RelationErrors relation_errors(std::span<const Relation> relations, std::vector<StampedPose> trajectory,
                               Duration span) {
  std::stable_sort(trajectory.begin(), trajectory.end(),
                   [](const StampedPose& a, const StampedPose& b) { return a.stamp < b.stamp; });
  RelationErrors errors;
  std::vector<double> translations, rotations;
  for (const Relation& relation : relations) {
    if (apart(relation.from, relation.to) > span) continue;
    ++errors.given;
    const std::optional<Pose> from = pose_at(trajectory, relation.from), to = pose_at(trajectory, relation.to);
    if (!from || !to) continue;
    const Pose error = between(relation.displacement, between(*from, *to));
    translations.push_back(length(error.position()));
    rotations.push_back(std::fabs(error.heading));
  }
  errors.used = translations.size();
  errors.translation_m = moments(translations);
  errors.rotation_rad = moments(rotations);
  errors.squared_translation_m2 = moments(squares(std::move(translations)));
  errors.squared_rotation_rad2 = moments(squares(std::move(rotations)));
  return errors;
}

std::string relations_json(std::span<const Relation> relations, const std::vector<StampedPose>& trajectory) {
  nlohmann::ordered_json object = json(relation_errors(relations, trajectory));
  object["within_20_s"] = json(relation_errors(relations, trajectory, 20s));
  return object.dump();
}

}  // namespace waitpoint::tools
