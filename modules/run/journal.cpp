// SPDX-License-Identifier: BSD-3-Clause
#include "modules/run/journal.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/file_contents.hpp"
#include "core/number_text.hpp"
#include "core/printable_line.hpp"
#include "modules/scenario/words.hpp"

namespace waitpoint::run {
namespace {

constexpr std::string_view first_line = "waitpoint journal 1";
constexpr std::string_view cut_off_word = "# cut off: ";
constexpr std::size_t bytes_max = std::size_t{64} << 20;
constexpr std::size_t decimals = 9;
constexpr std::size_t seconds_digits_max = 9;

const char* name(kernel::Order order) { return order == kernel::Order::seeded ? "seeded" : "fifo"; }

/// A line of an arbitrary file, made printable and short.
std::string shown(std::string_view line) {
  constexpr std::size_t letters_max = 60;
  std::string text(line.substr(0, letters_max));
  for (char& letter : text)
    if (letter < ' ' || letter > '~') letter = '?';
  return line.size() > letters_max ? text + "..." : text;
}

/// The lines of a file, with line numbers.
class Lines {
 public:
  explicit Lines(const std::filesystem::path& file)
      : at_{file.string(), 0}, text_(given_file_contents(file, bytes_max)) {
    rest_ = text_;
  }

  /// False at the end of the file. A last line without newline is truncated: BadInput.
  bool next(std::string_view& line) {
    if (rest_.empty()) return false;
    ++at_.line;
    const std::size_t end = rest_.find('\n');
    if (end == std::string_view::npos) throw at_.bad("expected a newline: the line is cut off");
    line = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    return true;
  }
  void expect(std::string_view expected, const std::string& otherwise) {
    std::string_view line;
    if (!next(line))
      throw scenario::Location{at_.file, at_.line + 1}.bad("the journal ends early, expected '" +
                                                           std::string(expected) + "'");
    if (line != expected)
      throw at_.bad(otherwise + ": expected '" + std::string(expected) + "', found '" + shown(line) + "'");
  }
  const scenario::Location& at() const { return at_; }

 private:
  scenario::Location at_;
  std::string text_;
  std::string_view rest_;
};

Time require_time(std::string_view& line, const scenario::Location& at) {
  const std::string word = scenario::take_word(line, at);
  const std::optional<Time> time = parse_time(word);
  if (!time) throw at.bad("expected a time in seconds, found '" + word + "'");
  return *time;
}

JournalEnd read_end(std::string_view line, const scenario::Location& at) {
  JournalEnd end;
  end.time = require_time(line, at);
  const std::string after = scenario::take_word(line, at), events = scenario::take_word(line, at),
                    unit = scenario::take_word(line, at);
  end.digest = scenario::take_word(line, at);
  if (after != "after" || unit != "events" || !parse_number(events, end.events) || end.digest.empty() ||
      !scenario::take_word(line, at).empty())
    throw at.bad("expected 'end TIME after N events DIGEST'");
  return end;
}

std::string scenario_line(const JournalHead& head) {
  std::string name = head.scenario;
  std::replace(name.begin(), name.end(), '\n', ' ');
  return "scenario " + name + " " + to_string(head.fingerprint);
}

}  // namespace

JournalHead journal_head(const scenario::Scenario& scenario, std::uint64_t seed, kernel::Order order) {
  return {scenario.name, Digest(scenario.fingerprint), seed, order};
}

std::string to_text(const JournalHead& head) {
  return fmt::format("{}\n{}\nseed {}\norder {}\n", first_line, scenario_line(head), head.seed, name(head.order));
}

std::string to_text(Time date, const Intervention& intervention) {
  return "at " + to_string(date) + " " + intervention.text + "\n";
}

std::string to_text(const JournalEnd& end) {
  return "end " + to_string(end.time) + " after " + std::to_string(end.events) + " events " + end.digest + "\n";
}

std::string cut_off_line(const std::string& reason) {
  return std::string(cut_off_word) + printable_line(reason) + "\n";
}

Journal read_journal(const std::filesystem::path& file, const JournalHead& head) {
  Lines lines(file);
  lines.expect(first_line, "this is no journal");
  lines.expect(scenario_line(head), "the journal of another scenario");
  lines.expect("seed " + std::to_string(head.seed), "the journal of another seed");
  lines.expect(std::string("order ") + name(head.order), "the journal of another order");
  Journal journal;
  std::string_view line;
  while (lines.next(line)) {
    if (journal.end) throw lines.at().bad("expected nothing after 'end'");
    if (!journal.cut_off.empty()) throw lines.at().bad("expected nothing after '# cut off'");
    if (line.starts_with(cut_off_word) && line.size() > cut_off_word.size()) {
      journal.cut_off = printable_line(line.substr(cut_off_word.size()));
      continue;
    }
    const std::string word = scenario::take_word(line, lines.at());
    if (word == "end") {
      journal.end = read_end(line, lines.at());
    } else if (word == "at") {
      const Time date = require_time(line, lines.at());
      journal.interventions.push_back({date, parse_intervention(line, lines.at())});
    } else {
      throw lines.at().bad("expected 'at' or 'end', found '" + word + "'");
    }
  }
  return journal;
}

std::optional<Time> parse_time(std::string_view text) {
  const std::size_t dot = std::min(text.find('.'), text.size());
  const std::string_view whole = text.substr(0, dot), part = text.substr(std::min(dot + 1, text.size()));
  constexpr std::string_view digits = "0123456789";
  if (whole.empty() || whole.size() > seconds_digits_max || part.size() > decimals ||
      (dot < text.size() && part.empty()) || whole.find_first_not_of(digits) != std::string_view::npos ||
      part.find_first_not_of(digits) != std::string_view::npos)
    return std::nullopt;
  std::int64_t ns = 0;
  const std::string all = std::string(whole) + std::string(part) + std::string(decimals - part.size(), '0');
  if (!parse_number(all, ns)) return std::nullopt;
  return Time::from_ns(ns);
}

}  // namespace waitpoint::run
