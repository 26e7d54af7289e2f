// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/reports/race_log.hpp"

#include <link.h>

#include <new>
#include <utility>

#include "core/error.hpp"
#include "fibers/kernel/access.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/posix/base/symbols.hpp"
#include "fibers/posix/descriptors/descriptors.hpp"
#include "fibers/posix/family/family.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/reports/memory.hpp"
#include "fibers/posix/traps/access_breakpoints.hpp"

namespace waitpoint::posix {
namespace {

RaceLog& log() {
  void* const known = family::common(family::Part::races, 0);
  WAITPOINT_CHECK(known != nullptr, "a race is found before there is a log");
  return *static_cast<RaceLog*>(known);
}

constexpr races::Listener listener = {
    [](const races::FoundRace& race) {
      const char* const name = symbol_at(reinterpret_cast<const void*>(race.address));
      const NewInFamily memory;
      races::LocatedRace located = races::located(race);
      if (name != nullptr) located.memory = name;
      log().races.push_back({family::own->id, record->robot.name, std::move(located)});
    },
    [](std::uint64_t place) {
      const NewInFamily memory;
      log().code.push_back(place);
    },
    [] { log().has_other_code = true; },
    [] { log().has_left_out_values = true; },
};

}  // namespace

namespace {

void begin_log(bool learn, bool notes, const races::Listener& heard) {
  WAITPOINT_CHECK(has_race_runtime(), "a log of races begins without the runtime that finds them");
  if (family::common(family::Part::races, 0) == nullptr) {
    void* const memory = family::common(family::Part::races, sizeof(RaceLog));
    if (memory == nullptr) refuse("there is no memory for the races of this run");
    new (memory) RaceLog();
  }
  const races::Runtime& runtime = *waitpoint_races_runtime();
  runtime.learn(learn);
  runtime.note_unlearned(notes);
  runtime.tell(heard);
  runtime.set_outside_apart();
  note_what_came = runtime.order_by_outside;
}

}  // namespace

bool has_race_runtime() { return &waitpoint_races_runtime != nullptr; }

void use_pages_for_races(void* zeroed, std::size_t bytes) { waitpoint_races_runtime()->use_pages(zeroed, bytes); }

void begin_race_log(bool learn, bool notes, Memory memory, std::span<const std::uint64_t> code) {
  begin_log(learn, notes, listener);
  waitpoint_races_runtime()->set_weak(memory == Memory::weak);
  for (const std::uint64_t place : code) waitpoint_races_runtime()->know(place);
}

namespace {

// By time: a breakpoint takes some microseconds.
struct HitLimits {
  std::uint32_t of_one, of_all;
};
constexpr HitLimits when_learning{1'000, 20'000}, when_exploring{1'000, 6'000}, when_observing{20'000, 200'000};

void report_accesses(std::span<const AccessInstruction> instructions, std::span<const AccessLibrary> libraries,
                     ReportAccess report, HitLimits limits) {
  constexpr std::uint32_t spins_max = 20'000;
  trap_accesses({.instructions = instructions,
                 .libraries = libraries,
                 .loaded = [](std::uint64_t loaded) { log().libraries = loaded; },
                 .report = report,
                 .switches = [] { return kernel::switches(record->scheduler()); },
                 .let_others_run = kernel::yield_after_computing,
                 .missed = [] { log().has_other_code = log().has_lost_breakpoints = true; },
                 .prevented = [](AccessObstacle obstacle) { log().obstacle = obstacle; },
                 .hits_of_one_max = limits.of_one,
                 .hits_max = limits.of_all,
                 .spins_max = spins_max});
}

std::uint64_t loaded_at = 0;  // the program

std::uint64_t program_start() {
  std::uint64_t start = 0;
  dl_iterate_phdr(
      [](dl_phdr_info* program, std::size_t, void* into) {
        *static_cast<std::uint64_t*>(into) = program->dlpi_addr;
        return 1;
      },
      &start);
  return start;
}

// As no atomic operation, which would order others. The place is told like that of a call, by the code behind it.
void report_conflicts(std::uint64_t address, std::uint32_t bytes, bool writes, bool, std::uint64_t place) {
  const bool is_of_program = place >> AccessInstruction::module_shift == 0;
  waitpoint_races_runtime()->accessed(address, bytes, writes, false, is_of_program ? loaded_at + place + 1 : place);
}

}  // namespace

void begin_conflict_log(std::span<const AccessInstruction> instructions, std::span<const AccessLibrary> libraries) {
  begin_log(false, false, listener);
  waitpoint_races_runtime()->set_weak(false);
  loaded_at = program_start();
  report_accesses(instructions, libraries, report_conflicts, when_observing);
}

void begin_access_log(bool learn, bool notes, std::span<const AccessInstruction> instructions,
                      std::span<const AccessLibrary> libraries, std::span<const std::uint64_t> code) {
  static constexpr races::Listener without_races = {[](const races::FoundRace&) {}, listener.learned,
                                                    listener.unlearned, listener.left_out_value};
  begin_log(learn, notes, without_races);
  const races::Runtime& runtime = *waitpoint_races_runtime();
  runtime.set_weak(false);
  for (const std::uint64_t place : code) runtime.know(place);
  report_accesses(instructions, libraries, runtime.accessed, learn ? when_learning : when_exploring);
}

}  // namespace waitpoint::posix
