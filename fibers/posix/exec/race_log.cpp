// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/exec/race_log.hpp"

#include "core/error.hpp"
#include "fibers/posix/program/program.hpp"

namespace waitpoint::posix {
namespace {

RaceLog& log() {
  WAITPOINT_CHECK(record->race_log != nullptr, "a race is found before there is a log");
  return *record->race_log;
}

constexpr races::Listener listener = {
    [](const races::FoundRace& race) { log().races.push_back(races::located(race)); },
    [](std::uint64_t place) { log().code.push_back(place); },
};

}  // namespace

RaceLog* start_race_log(bool learn, std::span<const std::uint64_t> code) {
  if (&waitpoint_races_runtime == nullptr) return nullptr;
  const races::Runtime& runtime = *waitpoint_races_runtime();
  for (const std::uint64_t place : code) runtime.know(place);
  runtime.learn(learn);
  runtime.tell(listener);
  return new RaceLog();
}

}  // namespace waitpoint::posix
