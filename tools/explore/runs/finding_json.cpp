// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/runs/finding_json.hpp"

#include <nlohmann/json.hpp>

namespace waitpoint::tools {
namespace {

const char* name_of(Finding::Kind kind) {
  switch (kind) {
    case Finding::Kind::passed: return "passed";
    case Finding::Kind::race: return "race";
    case Finding::Kind::misuse: return "misuse";
    case Finding::Kind::no_progress: return "no progress";
    case Finding::Kind::deadlock: return "deadlock";
    case Finding::Kind::unmet: return "not as expected";
    case Finding::Kind::exception: return "exception";
    case Finding::Kind::crash: return "crash";
    case Finding::Kind::killed: return "killed";
  }
  return "";
}

}  // namespace

std::string finding_json(const Finding& finding) {
  using Json = nlohmann::ordered_json;
  Json json{{"kind", name_of(finding.kind)}};
  if (!finding.words.empty()) json["message"] = finding.words;
  if (finding.kind != Finding::Kind::killed) json["time_s"] = finding.end.since_start().seconds();
  if (finding.digest != 0) json["digest"] = digest_text(finding.digest);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace waitpoint::tools
