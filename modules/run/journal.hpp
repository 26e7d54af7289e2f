// SPDX-License-Identifier: BSD-3-Clause
// The journal of a run: the interventions with their virtual times. With it the run repeats, with the same digest.
//
//   waitpoint journal 1
//   scenario office wp1:0123456789abcdef            its name, and the fingerprint of its files and --set options
//   seed 1
//   order fifo
//   at 12.340000000 move rackham 20 5 90            see intervention.hpp
//   end 30.000000000 after 123456 events wp1:...    time, number of events and digest at the end of the run
//
// Lines are written at once: the journal of a run that crashes is complete up to the crash, but has no end. Its last
// line may say why:
//
//   # cut off: the process dies of SIGFPE (integer division by zero)
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/digest.hpp"
#include "core/time.hpp"
#include "fibers/kernel/chooser.hpp"
#include "modules/run/intervention.hpp"
#include "modules/scenario/scenario.hpp"

namespace waitpoint::run {

/// Identifies a run.
struct JournalHead {
  std::string scenario;
  Digest fingerprint;
  std::uint64_t seed = 0;
  kernel::Order order = kernel::Order::fifo;
};
JournalHead journal_head(const scenario::Scenario& scenario, std::uint64_t seed, kernel::Order order);

struct JournalEnd {
  Time time;
  std::uint64_t events = 0;
  std::string digest;
};

struct DatedIntervention {
  Time date;
  Intervention intervention;
};

struct Journal {
  std::vector<DatedIntervention> interventions;  ///< in the order of the file
  std::optional<JournalEnd> end;                 ///< none: the run was cut off
  std::string cut_off;                           ///< the reason, if known
};

/// Lines of a journal, including newlines.
std::string to_text(const JournalHead& head);
std::string to_text(Time date, const Intervention& intervention);
std::string to_text(const JournalEnd& end);
/// The last line of a run that is cut off.
std::string cut_off_line(const std::string& reason);

/// Reads the journal of the run identified by `head`. Throws BadInput with file and line for a file that is no journal,
/// a malformed or truncated line, or the journal of another scenario, seed or order.
Journal read_journal(const std::filesystem::path& file, const JournalHead& head);

/// Parses seconds exactly: "12", "12.34"; at most nine decimals, at most 1e9 s. Nothing for other text.
std::optional<Time> parse_time(std::string_view text);

}  // namespace waitpoint::run
