// SPDX-License-Identifier: BSD-3-Clause
#include "modules/outside/report_source.hpp"

#include <fmt/format.h>

#include <chrono>
#include <utility>

#include "core/error.hpp"
#include "core/number_text.hpp"
#include "core/printable_line.hpp"
#include "modules/outside/words.hpp"
#include "modules/scenario/words.hpp"

namespace waitpoint::outside {
namespace {

constexpr int flood = 50;  // lines in one step of the world

/// Of this host: for lags of sources whose clocks show it, which a journal records.
double unix_time_s() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

}  // namespace

ReportSource::ReportSource(std::string robot, const Endpoint& endpoint, std::string declaration,
                           const std::string& where)
    : robot_(std::move(robot)), declaration_(std::move(declaration)), where_(where), listener_(endpoint, where) {}

void ReportSource::begin(Host& host) {
  host.intervene("external " + quoted_word(robot_) + declaration_, {where_, 0});
  host.tell(robot_, "external: awaits position reports at " + listener_.endpoint().text());
}

void ReportSource::accept(Host& host) {
  while (Descriptor waiting = listener_.accept()) {
    if (connection_) {
      LineStream(std::move(waiting)).send("refused: another source is connected\n");
      host.tell_fault(robot_, "a second source of reports was refused: one is connected");
      continue;
    }
    ++connections_;
    connection_.emplace(std::move(waiting));
    connection_->lines.send("waitpoint reports 1 " + robot_ + "\n");
    host.tell(robot_, "a source of reports is connected");
  }
}

// The end of a source is noticed before the next one is accepted, which may connect in the same step. One source is
// heard in a step.
void ReportSource::take_in(Host& host) {
  const bool had_source = connection_.has_value();
  if (had_source) hear(host);
  accept(host);
  if (connection_ && !had_source) hear(host);
}

void ReportSource::hear(Host& host) {
  LineStream& lines = connection_->lines;
  lines.receive();
  const int before = lines.lines();
  std::string line;
  while (lines.take(line)) obey(line, host);
  if (const int count = lines.lines() - before; count > flood)
    refuse("floods", fmt::format("flood: {} lines in one step of the world; the newest report counts", count), host);
  give_newest(host);
  if (lines.is_over()) end_connection(host);
}

void ReportSource::obey(std::string_view line, Host& host) {
  const scenario::Location written{listener_.endpoint().text(), connection_->lines.lines()};
  try {
    const std::string word = scenario::take_word(line, written);
    if (word == "report") return obey_report(line, written, host);
    if (word.empty()) return;
    if (word != "clock") throw written.bad("expected 'report' or 'clock', found '" + word + "'");
    const std::string name = scenario::take_word(line, written);
    scenario::require_end(line, written);
    const auto kind = SourceClock::kind_of(name);
    if (!kind) throw written.bad("expected clock own, unix or run, found '" + name + "'");
    connection_->clock = SourceClock(*kind);
  } catch (const BadInput& error) {
    refuse("malformed", error.what(), host);
  }
}

void ReportSource::obey_report(std::string_view words, const scenario::Location& written, Host& host) {
  const run::PositionReport report = run::parse_report(words, "stamp_s", written);
  const SourceClock::Dated dated = connection_->clock.date(report.time_s, host.next_step(), unix_time_s());
  if (!dated.refused.empty())
    return refuse(dated.refused.starts_with("from the past") ? "from the past" : "from the future",
                  written.bad("report " + dated.refused).what(), host);
  if (newest_) connection_->lines.send(fmt::format("superseded {}\n", newest_->time_s));
  newest_ = report;
  newest_date_s_ = dated.date_s;
  ++connection_->reports;
  ++reports_;
}

void ReportSource::refuse(const char* kind, const std::string& reason, Host& host) {
  const std::string text = printable_message(reason);
  connection_->lines.send("refused: " + text + "\n");
  faults_.add(kind);
  if (connection_->faults.add(kind)) host.tell_fault(robot_, text);
}

void ReportSource::give_newest(Host& host) {
  if (!newest_) return;
  run::PositionReport dated = *newest_;
  dated.time_s = newest_date_s_;
  host.intervene("report " + quoted_word(robot_) + " " + to_text(dated, "date_s"), {where_, 0});
  connection_->lines.send(fmt::format("taken {} at {}\n", newest_->time_s, to_string(host.next_step())));
  newest_.reset();
}

void ReportSource::end_connection(Host& host) {
  host.tell_fault(robot_, "the connection to the source ended after " + counted(connection_->reports, "report") +
                              connection_->faults.text());
  connection_.reset();
}

std::string ReportSource::account() const {
  if (connections_ == 0) return robot_ + ": no source of reports has connected to " + listener_.endpoint().text();
  return robot_ + ": " + counted(connections_, "connection") + ", " + counted(reports_, "report") + faults_.text();
}

}  // namespace waitpoint::outside
