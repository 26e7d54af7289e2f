// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fit/fit_json.hpp"

#include <nlohmann/json.hpp>

namespace waitpoint::tools {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const OdometryFit& of) {
  return {{"travel_scale", of.travel_scale},
          {"turn_scale", of.turn_scale},
          {"drift_rad_per_m", of.drift_rad_per_m},
          {"travel_noise_m_per_sqrt_m", of.travel_noise_m_per_sqrt_m},
          {"turn_noise_rad_per_sqrt_m", of.turn_noise_rad_per_sqrt_m},
          {"turn_noise_rad_per_sqrt_rad", of.turn_noise_rad_per_sqrt_rad},
          {"turns_seen", of.turns_seen},
          {"stretches", of.stretches},
          {"left_out", of.left_out},
          {"uncorrected", of.uncorrected}};
}

Json json_of(const LaserFit& of) {
  return {{"beams", of.beams},
          {"stride", of.stride},
          {"field_of_view_rad", of.field_of_view_rad},
          {"range_max_m", of.range_max_m},
          {"resolution_m", of.resolution_m},
          {"range_noise_m", of.range_noise_m},
          {"noise_pairs", of.noise_pairs},
          {"dropout", of.dropout},
          {"period_s", of.period_s},
          {"jitter_s", of.jitter_s},
          {"missing", of.missing}};
}

}  // namespace

std::string fit_json(const RobotFit& fit) {
  const Json json{{"name", fit.name},
                  {"log", fit.log},
                  {"v_max_m_s", fit.v_max_m_s},
                  {"w_max_rad_s", fit.w_max_rad_s},
                  {"mount", {{"x_m", fit.mount.x}, {"y_m", fit.mount.y}, {"heading_rad", fit.mount.heading}}},
                  {"odometry", json_of(fit.odometry)},
                  {"laser", json_of(fit.laser)},
                  {"robot_type", robot_type_text(fit)}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace waitpoint::tools
