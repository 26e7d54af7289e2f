// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/races/races.hpp"

#include <algorithm>
#include <ostream>
#include <set>

#include "core/error.hpp"
#include "fibers/explore/races/located_race.hpp"

namespace waitpoint::races {
namespace {

const Runtime* runtime() { return &waitpoint_races_runtime == nullptr ? nullptr : waitpoint_races_runtime(); }

// The source line of an access, independent of the function; its address if no line is known.
std::string line_of(const Side& side, const std::vector<std::string>& calls) {
  const std::string before = " at ";
  const std::size_t line = calls.empty() ? std::string::npos : calls.front().rfind(before);
  return line != std::string::npos ? calls.front().substr(line + before.size()) : std::to_string(side.access.place);
}

Access access_of(const Side& side, std::vector<std::string> calls) {
  std::optional<std::uint32_t> number;
  if (side.record != 0) number = side.record - 1;
  std::string line = line_of(side, calls);
  return {side.task,        number,           side.access.event, side.access.writes(), side.access.is_atomic(),
          side.access.size, std::move(calls), std::move(line)};
}

// The identity of a race in the report of a run: a variable and two lines. `++n` is a read and a write.
using Told = std::pair<const void*, Lines>;

void write(std::ostream& out, const char* which, const Access& access) {
  out << "  " << which << ": " << (access.atomic ? "atomic " : "") << (access.writes ? "write" : "read") << " of "
      << access.size
      << (access.size == 63  ? " bytes or more"
          : access.size == 1 ? " byte"
                             : " bytes")
      << " by task " << access.task;
  if (access.number) out << "#" << *access.number;
  out << ", after its event " << access.event << "\n";
  for (const std::string& call : access.calls) out << "    " << call << "\n";
}

constexpr std::size_t calls_written = 8;

}  // namespace

bool present() { return runtime() != nullptr; }

void begin_run() {
  if (present()) runtime()->begin_run();
}

bool any_found() {
  const FoundRace* races = nullptr;
  return present() && runtime()->found(races) != 0;
}

std::vector<Race> found() {
  if (!present()) return {};
  const FoundRace* races = nullptr;
  const std::size_t count = runtime()->found(races);
  std::vector<LocatedRace> all;
  for (std::size_t i = 0; i < count; ++i) all.push_back(located(races[i]));
  return in_words(all);
}

std::vector<Race> in_words(std::span<const LocatedRace> races) {
  std::vector<sync::CodePlaces> stacks;
  for (const LocatedRace& race : races) {
    stacks.push_back(race.first_calls);
    stacks.push_back(race.second_calls);
  }
  std::vector<std::vector<std::string>> calls = sync::user_source_lines(stacks, calls_written);
  std::vector<Race> told;
  std::set<Told> known;
  for (std::size_t i = 0; i < races.size(); ++i) {
    const FoundRace& found = races[i].found;
    Race race{access_of(found.first, std::move(calls[2 * i])), access_of(found.second, std::move(calls[2 * i + 1])),
              reinterpret_cast<const void*>(found.address), races[i].memory};
    if (known.insert({race.address, race.lines()}).second) told.push_back(std::move(race));
  }
  return told;
}

void learn(bool on) {
  if (present()) runtime()->learn(on);
}

void forget_learned() {
  if (present()) runtime()->forget_learned();
}

void note_unlearned(bool on) {
  if (present()) runtime()->note_unlearned(on);
}

bool noted_unlearned() { return present() && runtime()->noted_unlearned(); }

void set_weak_memory(bool on) {
  WAITPOINT_CHECK(present() || !on, "weak memory is asked for without the runtime that has it");
  if (present()) runtime()->set_weak(on);
}

void forget_left_out_values() {
  if (present()) runtime()->forget_left_out_values();
}

bool left_out_values() { return present() && runtime()->left_out_values(); }

std::string headline(const Race& race) {
  const auto words = [](const Access& access) {
    return std::string(access.atomic ? "atomic " : "") + (access.writes ? "write" : "read") + " at " + access.line;
  };
  std::string text = "data race of the " + words(race.first) + " and the " + words(race.second);
  return race.memory.empty() ? text : text + " (" + race.memory + ")";
}

std::ostream& operator<<(std::ostream& out, const Race& race) {
  out << "data race at " << race.address;
  if (!race.memory.empty()) out << " (" << race.memory << ")";
  out << "\n";
  write(out, "first", race.first);
  write(out, "second", race.second);
  return out;
}

}  // namespace waitpoint::races
