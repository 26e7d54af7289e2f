// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/search_json.hpp"

#include <nlohmann/json.hpp>

#include "tools/explore/runs/finding_json.hpp"

namespace waitpoint::tools {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const SearchCounts& counts) {
  Json json{{"schedules", counts.schedules}, {"distinct", counts.distinct}, {"failed", counts.failures},
            {"raced", counts.raced},         {"seconds", counts.seconds},   {"exhausted", counts.scope.has_value()}};
  if (counts.scope && !counts.scope->empty()) json["scope"] = *counts.scope;
  if (!counts.obstacle.empty()) json["calls_only"] = counts.obstacle;
  return json;
}

Json json_of(const ReportedFailure& failure) {
  const auto& [finding, report] = failure;
  Json json = Json::parse(finding_json(finding));
  if (report.schedule.digest != 0) json["digest"] = digest_text(report.schedule.digest);  // of the minimised one
  json["schedule"] = report.finding.schedule;
  json["switches"] = report.schedule.switches.size();
  if (!report.finding.choice.empty()) json["choice"] = report.finding.choice;
  json["races"] = Json::array();
  for (const ToldRace& race : report.races) json["races"].push_back(race.headline);
  json["replay"] = report.finding.replay;
  json["debug"] = report.finding.debug;
  json["report"] = report.text;
  return json;
}

}  // namespace

std::string search_json(const std::string& target, const std::optional<SearchCounts>& counts,
                        const ReportedFailure* failure) {
  const bool is_interrupted = counts && counts->is_interrupted;
  Json json{{"target", target}, {"outcome", failure != nullptr ? "failed" : is_interrupted ? "interrupted" : "passed"}};
  if (counts) json["search"] = json_of(*counts);
  if (failure != nullptr) json["failure"] = json_of(*failure);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace waitpoint::tools
