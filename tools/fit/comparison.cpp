// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fit/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "tools/fit/median.hpp"
#include "tools/fit/odometry_fit.hpp"
#include "tools/fit/scan_samples.hpp"

namespace waitpoint::tools {
namespace {

constexpr double stretch_m = 2;

Described described(const std::vector<double>& values) {
  const auto count = static_cast<double>(values.size());
  double mean = 0, squares = 0;
  for (const double value : values) mean += value / count;
  for (const double value : values) squares += exact::square(value - mean) / count;
  return {values.size(), median(values), std::sqrt(squares)};
}

std::vector<double> times_between_scans(const logs::PlayingOrder& order) {
  std::vector<double> times_s;
  std::optional<Time> before;
  for (const logs::Played& record : order.records) {
    if (!record.scan) continue;
    if (before) times_s.push_back((record.date - *before).seconds());
    before = record.date;
  }
  return times_s;
}

std::vector<double> jitter_of(const std::vector<double>& times_s) {
  const double period_s = median(times_s);
  std::vector<double> jitter_s;
  for (const double time_s : times_s)
    if (time_s < 1.5 * period_s) jitter_s.push_back(time_s - period_s);
  return jitter_s;
}

nlohmann::ordered_json json_of(const Described& sample) {
  if (sample.number == 0) return {{"number", 0}, {"median", nullptr}, {"deviation", nullptr}};
  return {{"number", sample.number}, {"median", sample.median}, {"deviation", sample.deviation}};
}

}  // namespace

std::vector<Sample> samples_of(const ReplayedLog& log) {
  std::vector<double> travel, turn;
  for (const Stretch& of : stretches_of(log.measured, log.localised, stretch_m)) {
    travel.push_back(of.measured_travel_m - of.travel_m);
    turn.push_back(of.measured_turn_rad - of.turn_rad);
  }
  std::vector<double> times_s = times_between_scans(log.order), jitter_s = jitter_of(times_s);
  SegmentSamples segments = segments_of(log.log);
  MatchSamples matches = matches_of(log);
  return {{"odometry's travel error in 2 m, m", std::move(travel)},
          {"odometry's heading error in 2 m, rad", std::move(turn)},
          {"time between scans, s", std::move(times_s)},
          {"jitter of that time, s", std::move(jitter_s)},
          {"segments of a scan", std::move(segments.numbers)},
          {"length of a segment, m", std::move(segments.lengths_m)},
          {"deviation of a segment's echoes, m", std::move(segments.deviations_m)},
          {"deviation of a scan match, m", std::move(matches.deviations_m)},
          {"share of echoes that match", std::move(matches.explained)}};
}

std::vector<Compared> compared(std::span<const Sample> first, std::span<const Sample> second) {
  WAITPOINT_CHECK(first.size() == second.size(), "samples of other quantities are compared");
  std::vector<Compared> rows;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const std::vector<double>&a = first[i].values, &b = second[i].values;
    rows.push_back({first[i].quantity, described(a), described(b), std::nullopt});
    if (!a.empty() && !b.empty()) rows.back().test = compare_samples(a, b);
  }
  return rows;
}

std::string comparison_text(std::span<const Compared> rows) {
  std::string text = fmt::format("  {:<37}{:>7} {:>9} {:>9}   {:>7} {:>9} {:>9}   {:>6} {:>6} {:>8}\n", "quantity",
                                 "number", "median", "deviation", "number", "median", "deviation", "D", "delta", "p");
  for (const Compared& row : rows) {
    text += fmt::format("  {:<37}", row.quantity);
    for (const Described& of : {row.first, row.second})
      text += of.number > 0 ? fmt::format("{:>7} {:>9.4f} {:>9.4f}   ", of.number, of.median, of.deviation)
                            : fmt::format("{:>7} {:>9} {:>9}   ", 0, "-", "-");
    text += row.test ? fmt::format("{:>6.3f} {:>6.3f} {:>8.2g}\n", row.test->distance, row.test->delta,
                                   row.test->probability)
                     : fmt::format("{:>6} {:>6} {:>8}\n", "-", "-", "-");
  }
  return text;
}

std::string comparison_json(const std::string& first, const std::string& second, std::span<const Compared> rows) {
  nlohmann::ordered_json object{{"first", first}, {"second", second}, {"quantities", nlohmann::ordered_json::array()}};
  for (const Compared& row : rows) {
    nlohmann::ordered_json of{
        {"quantity", row.quantity}, {"first", json_of(row.first)}, {"second", json_of(row.second)}};
    of["distance"] = row.test ? nlohmann::ordered_json(row.test->distance) : nullptr;
    of["delta"] = row.test ? nlohmann::ordered_json(row.test->delta) : nullptr;
    of["probability"] = row.test ? nlohmann::ordered_json(row.test->probability) : nullptr;
    object["quantities"].push_back(std::move(of));
  }
  using Json = nlohmann::ordered_json;
  return object.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace waitpoint::tools
