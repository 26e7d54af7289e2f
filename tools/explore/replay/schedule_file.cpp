// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/replay/schedule_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <sstream>

#include "core/error.hpp"
#include "core/file_contents.hpp"
#include "core/number_text.hpp"
#include "tools/explore/runs/finding.hpp"

namespace waitpoint::tools {
namespace {

using exploration::Switch;
using kernel::Choice;

constexpr std::string_view choices[] = {"task", "waiter", "spurious", "loss", "computing", "process", "value"};
constexpr std::size_t bytes_max = std::size_t{64} << 20;
constexpr std::size_t words_max = 5;  // an alternative that is not an event is one word, in choices of processes two
constexpr std::string_view digest_prefix = "wp1:";
constexpr std::size_t digest_digits = 16;

class Lines {
 public:
  explicit Lines(const std::filesystem::path& file)
      : name_(file.string()), stream_(given_file_contents(file, bytes_max)) {}
  /// Splits the next line into words; false at the end.
  bool next() {
    std::string line;
    if (!std::getline(stream_, line)) return false;
    ++number_;
    words.clear();
    for (std::size_t at = 0; at <= line.size();) {
      const std::size_t end = std::min(line.find(' ', at), line.size());
      words.push_back(line.substr(at, end - at));
      at = end + 1;
    }
    return true;
  }
  /// Reads the next line, which must begin with `word` and have `count` words.
  void expect(const std::string& word, std::size_t count, const std::string& form) {
    const bool is_there = next();
    if (!is_there) ++number_;
    if (!is_there || words.front() != word || words.size() != count) refuse(form);
  }
  [[noreturn]] void refuse(const std::string& expected) const {
    throw BadInput(name_, number_, "expected " + expected);
  }
  std::uint64_t number(std::size_t word, int base, const std::string& form) const {
    std::uint64_t number = 0;
    const std::string& text = words[word];
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, base);
    if (error != std::errc() || end != text.data() + text.size()) refuse(form);
    return number;
  }
  std::vector<std::string> words;

 private:
  std::string name_;
  std::istringstream stream_;
  int number_ = 0;
};

bool has_two_words(Choice choice) { return choice == Choice::task || choice == Choice::process; }

Switch read_switch(const Lines& line) {
  const std::string form =
      "a switch such as 'task 00000000000000aa 12 00000000000000bb 7' or 'computing "
      "00000000000000aa 13 62'";
  const auto known = std::find(std::begin(choices), std::end(choices), line.words.front());
  if (known == std::end(choices)) line.refuse(form);
  Switch change;
  change.choice = static_cast<Choice>(known - std::begin(choices));
  const bool has_two = has_two_words(change.choice);
  if (line.words.size() != (has_two ? words_max : words_max - 1)) line.refuse(form);
  change.usual = {line.number(1, 16, form), line.number(2, 10, form)};
  change.instead.task = line.number(3, change.choice == Choice::task ? 16 : 10, form);
  if (has_two) change.instead.sequence = line.number(4, 10, form);
  return change;
}

}  // namespace

std::string to_text(const StoredSchedule& schedule) {
  std::string text = fmt::format("waitpoint schedule 1\nscenario {:016x}\ndrawn {} {} {}\nfrom {}\ndigest {}",
                                 schedule.fingerprint, schedule.strategy, schedule.seed, schedule.number,
                                 to_string(schedule.from), digest_text(schedule.digest));
  if (!schedule.trail.marks.empty()) text += " " + to_text(schedule.trail);
  text += "\n";
  for (const Switch& change : schedule.switches) {
    text += fmt::format("{} {:016x} {} ", choices[static_cast<std::size_t>(change.choice)], change.usual.task,
                        change.usual.sequence);
    text += fmt::format(fmt::runtime(change.choice == Choice::task ? "{:016x}" : "{}"), change.instead.task);
    text += has_two_words(change.choice) ? fmt::format(" {}\n", change.instead.sequence) : "\n";
  }
  return text;
}

StoredSchedule read_schedule(const std::filesystem::path& file) {
  Lines lines(file);
  StoredSchedule schedule;
  lines.expect("waitpoint", 3, "'waitpoint schedule 1'");
  if (lines.words[1] != "schedule" || lines.words[2] != "1") lines.refuse("'waitpoint schedule 1'");
  lines.expect("scenario", 2, "'scenario' and the digest of the scenario");
  schedule.fingerprint = lines.number(1, 16, "the scenario's digest as hexadecimal digits");
  const std::string drawn = "'drawn', a strategy, a seed and a number";
  lines.expect("drawn", 4, drawn);
  schedule.strategy = lines.words[1];
  schedule.seed = lines.number(2, 10, drawn);
  schedule.number = lines.number(3, 10, drawn);
  lines.expect("from", 2, "'from' and a time in seconds");
  double from_s = 0;
  if (!parse_number(lines.words[1], from_s) || !(from_s >= 0 && from_s <= 1e9))
    lines.refuse("'from' and a time in seconds");
  schedule.from = Time() + Duration::from_seconds(from_s);
  const std::string digest = "'digest', the digest of the run, and its trail if known";
  if (!lines.next() || lines.words.front() != "digest" || lines.words.size() < 2 || lines.words.size() > 3)
    lines.refuse(digest);
  if (!lines.words[1].starts_with(digest_prefix)) lines.refuse("a digest that begins with wp1:");
  lines.words[1].erase(0, digest_prefix.size());
  if (lines.words[1].size() != digest_digits) lines.refuse("sixteen digits of a digest after wp1:");
  schedule.digest = lines.number(1, 16, digest);
  if (lines.words.size() == 3 && !exploration::read_trail(lines.words[2], schedule.trail)) lines.refuse(digest);
  while (lines.next()) schedule.switches.push_back(read_switch(lines));
  return schedule;
}

}  // namespace waitpoint::tools
