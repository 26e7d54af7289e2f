// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/search_json.hpp"

#include <nlohmann/json.hpp>

#include "tools/command/interruption.hpp"
#include "tools/exec/access_obstacles.hpp"
#include "tools/explore/runs/finding_json.hpp"

namespace waitpoint::tools {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const exploration::NewPairChance& chance) {
  return {{"strategy", chance.strategy},        {"switch_at_accesses", chance.is_at_accesses},
          {"schedules", chance.schedules},      {"pairs", chance.pairs},
          {"new_pair_chance", chance.estimate}, {"lower_bound", chance.lower_bound},
          {"upper_bound", chance.upper_bound}};
}

Json json_of(const exploration::Search& search, double seconds) {
  Json json{{"schedules", search.schedules()},
            {"distinct", search.distinct()},
            {"failed", search.failures()},
            {"raced", search.raced()},
            {"seconds", seconds},
            {"exhausted", search.scope().has_value()}};
  if (const auto& scope = search.scope(); scope && !scope->empty()) json["scope"] = *scope;
  if (!search.unproved().empty()) json["unproved"] = search.unproved();
  if (const std::string obstacle = words_of(search.obstacle()); !obstacle.empty()) json["calls_only"] = obstacle;
  if (search.generated_code() > 0) json["generated_code_bytes"] = search.generated_code();
  if (const auto chance = search.scope() ? std::nullopt : search.chance_of_news()) json["seen"] = json_of(*chance);
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

std::string search_json(const std::string& target, const exploration::Search* search, double seconds,
                        const ReportedFailure* failure) {
  const char* const passed = search != nullptr && search->schedules() == 0 ? "nothing run" : "passed";
  const char* const outcome = failure != nullptr ? "failed" : interruption() != 0 ? "interrupted" : passed;
  Json json{{"target", target}, {"outcome", outcome}};
  if (search != nullptr) json["search"] = json_of(*search, seconds);
  if (failure != nullptr) json["failure"] = json_of(*failure);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace waitpoint::tools
