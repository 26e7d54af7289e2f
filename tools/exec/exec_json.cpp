// SPDX-License-Identifier: BSD-3-Clause
#include "tools/exec/exec_json.hpp"

#include <nlohmann/json.hpp>
#include <sstream>

#include "tools/command/signal_words.hpp"
#include "tools/exec/family_report.hpp"
#include "tools/exec/misuse_report.hpp"
#include "tools/exec/race_report.hpp"

namespace waitpoint::tools {
namespace {

using Json = nlohmann::ordered_json;

const char* name_of(posix::Ending ending) {
  switch (ending) {
    case posix::Ending::own: return "own";
    case posix::Ending::deadlock: return "deadlock";
    case posix::Ending::no_progress: return "no progress";
    case posix::Ending::idle: return "idle";
    case posix::Ending::cut_off: return "cut off";
  }
  return "";
}

void put_run(const posix::Record& record, Json& json) {
  const RunCounts counts = counts_in(record);
  json["ending"] = name_of(record.ending);
  json["digest"] = to_string(digest_of(record));
  json["processes"] = counts.processes;
  json["threads"] = counts.threads;
  json["threads_at_once"] = counts.threads_at_once;
  json["events"] = counts.events;
  json["switches"] = counts.switches;
  json["virtual_s"] = counts.time.since_start().seconds();
  json["races"] = Json::array();
  for (const auto& [process, found] : races_by_process(record))
    for (const races::Race& race : found) {
      std::ostringstream text;
      text << race;
      Json entry{{"text", text.str()}};
      if (!process.empty()) entry["process"] = process;
      json["races"].push_back(std::move(entry));
    }
  if (const std::string misuse = first_misuse(record); !misuse.empty()) json["misuse"] = misuse;
}

}  // namespace

std::string exec_json(const NamedRun& named, const ProgramRun& run, const posix::Record& record) {
  Json json{{"program", named.program}, {"seed", named.seed}};
  if (run.end().signal() != 0)
    json["signal"] = signal_name(run.end().signal());
  else
    json["exit_status"] = run.end().exit_status();
  if (record.began) put_run(record, json);
  json["replay"] = named.replay;
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string seeds_json(const std::string& program, std::uint64_t runs, std::uint64_t schedules,
                       const std::string& failed) {
  Json json{{"program", program}, {"runs", runs}, {"schedules", schedules}};
  if (!failed.empty()) json["failed"] = Json::parse(failed);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace waitpoint::tools
