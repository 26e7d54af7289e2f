// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/replay/replay_json.hpp"

#include <nlohmann/json.hpp>

#include "tools/explore/runs/finding_json.hpp"

namespace waitpoint::tools {

std::string replay_json(const ExploreOptions& options, const ReplayRecord& record, const Finding& finding,
                        const std::string& summary) {
  using Json = nlohmann::ordered_json;
  Json json{{"replayed", options.replay},
            {"outcome", finding.passed() ? "passed" : "failed"},
            {"digest_is_recorded", record.digest_bits > 0},
            {"run", Json::parse(finding_json(finding))}};
  if (!summary.empty()) json["summary"] = Json::parse(summary);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace waitpoint::tools
