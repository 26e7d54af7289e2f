// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/runs/finding_json.hpp"

#include <nlohmann/json.hpp>

namespace waitpoint::tools {
namespace {

const char* words_of_kind(ProcessFinding::Kind kind) {
  switch (kind) {
    case ProcessFinding::Kind::passed: return "passed";
    case ProcessFinding::Kind::race: return "race";
    case ProcessFinding::Kind::misuse: return "misuse";
    case ProcessFinding::Kind::no_progress: return "no progress";
    case ProcessFinding::Kind::deadlock: return "deadlock";
    case ProcessFinding::Kind::unmet: return "not as expected";
    case ProcessFinding::Kind::exception: return "exception";
    case ProcessFinding::Kind::crash: return "crash";
    case ProcessFinding::Kind::killed: return "killed";
  }
  return "";
}

}  // namespace

std::string finding_json(const ProcessFinding& finding) {
  using Json = nlohmann::ordered_json;
  Json json{{"kind", words_of_kind(finding.kind)}};
  if (!finding.words.empty()) json["message"] = finding.words;
  if (finding.kind != ProcessFinding::Kind::killed) json["time_s"] = finding.end.since_start().seconds();
  if (finding.digest != 0) json["digest"] = digest_text(finding.digest);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace waitpoint::tools
