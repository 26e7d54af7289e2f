// SPDX-License-Identifier: BSD-3-Clause
#include "tools/run/run_json.hpp"

#include <nlohmann/json.hpp>

#include "tools/output/summary.hpp"

namespace waitpoint::tools {
namespace {

using Json = nlohmann::ordered_json;

std::string with_valid_text(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

}  // namespace

std::string run_json(const bridge::RunResult& result, const std::vector<std::string>& unmet,
                     const std::string& replay) {
  Json json = Json::parse(summary_json(result));
  json["unmet"] = unmet;
  json["replay"] = replay;
  return with_valid_text(json);
}

std::string runs_json(std::span<const bridge::RunResult> results, const std::optional<FailedSeed>& failed) {
  Json json = Json::parse(summary_json(results));
  if (failed) json["failed"] = {{"seed", failed->seed}, {"reason", failed->reason}, {"replay", failed->replay}};
  return with_valid_text(json);
}

}  // namespace waitpoint::tools
