// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/runs/finding_json.hpp"

#include <nlohmann/json.hpp>

namespace waitpoint::tools {
namespace {

const char* words_of_kind(RunVerdict::Kind kind) {
  switch (kind) {
    case RunVerdict::Kind::passed: return "passed";
    case RunVerdict::Kind::race: return "race";
    case RunVerdict::Kind::misuse: return "misuse";
    case RunVerdict::Kind::no_progress: return "no progress";
    case RunVerdict::Kind::deadlock: return "deadlock";
    case RunVerdict::Kind::unmet: return "not as expected";
    case RunVerdict::Kind::exception: return "exception";
    case RunVerdict::Kind::crash: return "crash";
    case RunVerdict::Kind::killed: return "killed";
  }
  return "";
}

}  // namespace

std::string finding_json(const Finding& finding) {
  using Json = nlohmann::ordered_json;
  Json json{{"kind", words_of_kind(finding.kind)}};
  if (!finding.words.empty()) json["message"] = finding.words;
  if (finding.kind != RunVerdict::Kind::killed) json["time_s"] = finding.end.since_start().seconds();
  if (finding.digest != 0) json["digest"] = digest_text(finding.digest);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace waitpoint::tools
