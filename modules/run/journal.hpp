// SPDX-License-Identifier: BSD-3-Clause
// The journal of a run: what a person did, each at its virtual time. With it the run repeats, to the same digest.
//
//   waitpoint journal 1
//   scenario office wp1:0123456789abcdef            its name, and a fingerprint of all that its files and --set say
//   seed 1
//   order fifo
//   at 12.340000000 move rackham 20 5 90            see intervention.hpp
//   end 30.000000000 after 123456 events wp1:...    where the run was left, and its digest there
//
// Lines are written as things happen, so that the journal of a run that stops at a bug is there up to it: it has no
// end.
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

/// Which run it is.
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
  std::optional<JournalEnd> end;                 ///< none: the run that wrote it did not come to an end
};

/// Lines of a journal, with their newlines.
std::string to_text(const JournalHead& head);
std::string to_text(Time date, const Intervention& intervention);
std::string to_text(const JournalEnd& end);

/// Reads the journal of the run that `head` says. Throws BadInput with file and line: no journal, a line that cannot be
/// read or is cut off, the journal of another scenario, seed or order.
Journal read_journal(const std::filesystem::path& file, const JournalHead& head);

/// Seconds in decimals, exactly: "12", "12.34", at most nine decimals, at most 1e9 s; nothing if it is no such number.
std::optional<Time> parse_time(std::string_view text);

}  // namespace waitpoint::run
