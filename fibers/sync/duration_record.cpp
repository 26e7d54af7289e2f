// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/duration_record.hpp"

#include <charconv>

#include "core/printable_line.hpp"
#include "fibers/kernel/run.hpp"

namespace waitpoint {
namespace {

constexpr std::string_view first_line = "waitpoint durations 1";
constexpr std::string_view cut_off_word = "# cut off: ";

/// Splits a text into lines, or a line into words, from left to right.
std::string_view take_until(std::string_view& rest, char separator) {
  const std::size_t at = rest.find(separator);
  const std::string_view taken = rest.substr(0, at);
  rest.remove_prefix(at == std::string_view::npos ? rest.size() : at + 1);
  return taken;
}

template <class Number>
bool read(std::string_view word, Number& number, int base = 10) {
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number, base);
  return error == std::errc() && end == word.data() + word.size();
}

std::string hexadecimal(std::uint64_t value) {
  char digits[17];
  const auto [end, error] = std::to_chars(digits, digits + 16, value, 16);
  return std::string(digits, end);
}

// One line after the head; false if it is malformed.
bool read_line(std::string_view line, DurationRecord& record) {
  const std::string_view word = take_until(line, ' ');
  if (word == "task") {
    DurationRecord::TaskName task;
    std::uint32_t number = 0;
    if (!read(take_until(line, ' '), number) || number != record.tasks.size() + 1) return false;
    if (!read(take_until(line, ' '), task.id, 16) || line.empty()) return false;
    task.name = line;
    record.tasks.push_back(std::move(task));
    return true;
  }
  DurationRecord::Entry entry;
  if (!read(word, entry.task) || entry.task == 0 || entry.task > record.tasks.size()) return false;
  --entry.task;
  if (!read(line, entry.ns) || entry.ns < 0) return false;
  record.entries.push_back(entry);
  return true;
}

}  // namespace

std::string to_text(const DurationRecord& record) {
  std::string text = std::string(first_line) + "\nrun " + record.run + "\n";
  std::size_t named = 0;
  for (const DurationRecord::Entry& entry : record.entries) {
    for (; named <= entry.task; ++named) {
      const DurationRecord::TaskName& task = record.tasks[named];
      text += "task " + std::to_string(named + 1) + " " + hexadecimal(task.id) + " " + task.name + "\n";
    }
    text += std::to_string(entry.task + 1) + " " + std::to_string(entry.ns) + "\n";
  }
  text += "end " + std::to_string(record.entries.size()) + "\n";
  return record.cut_off.empty() ? text : text + std::string(cut_off_word) + printable_line(record.cut_off) + "\n";
}

DurationRecord parse_duration_record(const std::string& file, std::string_view text) {
  DurationRecord record;
  int number = 0;
  const auto bad = [&](const std::string& message) { return BadInput(file, number, message); };
  const auto next_line = [&] {
    ++number;
    if (text.empty()) throw bad("the record of durations ends early: expected its last line, 'end' and a number");
    return take_until(text, '\n');
  };
  if (next_line() != first_line) throw bad("expected a record of durations, '" + std::string(first_line) + "'");
  std::string_view run = next_line();
  if (take_until(run, ' ') != "run" || run.empty()) throw bad("expected 'run' and the run of the record");
  record.run = run;
  std::string_view line = next_line();
  for (; !line.starts_with("end"); line = next_line())
    if (!read_line(line, record)) throw bad("expected a task and its duration, found '" + std::string(line) + "'");
  std::size_t count = 0;
  take_until(line, ' ');
  if (!read(line, count) || count != record.entries.size())
    throw bad("the record says that it has " + std::string(line) + " durations, but " +
              std::to_string(record.entries.size()) + " are there");
  if (text.empty()) return record;
  line = next_line();
  if (!line.starts_with(cut_off_word) || line.size() == cut_off_word.size() || !text.empty())
    throw bad("expected nothing after 'end' but '" + std::string(cut_off_word) + "' and a reason");
  record.cut_off = printable_line(line.substr(cut_off_word.size()));
  return record;
}

DurationRecorder::DurationRecorder(Simulation& simulation, std::string run) {
  record_.run = std::move(run);
  pass = [](kernel::Durations& durations, const kernel::Task& task, Duration cost) {
    auto& self = static_cast<DurationRecorder&>(durations);
    const auto place = static_cast<std::uint32_t>(self.record_.tasks.size());
    const auto [at, is_new] = self.places_.try_emplace(task.id, place);
    if (is_new) self.record_.tasks.push_back({task.id, std::string(task.robot->name) + "." + task.name});
    self.record_.entries.push_back({at->second, cost.ns()});
    return cost;
  };
  kernel::hooks(simulation.scheduler()).durations = this;
}

DurationReplay::DurationReplay(Simulation& simulation, const DurationRecord& record, const std::string& run,
                               std::string file)
    : record_(record), file_(std::move(file)) {
  if (record.run != run)
    throw BadInput(file_, 2, "the record of durations is of run '" + record.run + "', but this is '" + run + "'");
  pass = [](kernel::Durations& durations, const kernel::Task& task, Duration) {
    return static_cast<DurationReplay&>(durations).next(task);
  };
  kernel::hooks(simulation.scheduler()).durations = this;
}

Duration DurationReplay::next(const kernel::Task& task) {
  std::string wrong;
  if (next_ == record_.entries.size()) {
    wrong = "ends early: the run continues after its " + std::to_string(next_) + " durations";
    if (!record_.cut_off.empty()) wrong += ", as its own was cut off: " + record_.cut_off;
  } else if (const auto& entry = record_.entries[next_]; record_.tasks[entry.task].id != task.id) {
    wrong = "belongs to another run: its duration " + std::to_string(next_ + 1) + " is of task '" +
            record_.tasks[entry.task].name + "', but the next is of '" + task.robot->name + "." + task.name + "'";
  } else {
    ++next_;
    return Duration::from_ns(entry.ns);
  }
  Simulation::of(*task.scheduler)
      .fail(std::make_exception_ptr(BadInput(file_, "the record of durations " + wrong + ", at " +
                                                        to_string(kernel::global_time(*task.scheduler)) + " s")));
  return Duration();
}

void DurationReplay::check_used_up() const {
  if (next_ == record_.entries.size()) return;
  throw BadInput(file_, "the record of durations belongs to another run: of its " +
                            std::to_string(record_.entries.size()) + " durations, this one took " +
                            std::to_string(next_));
}

}  // namespace waitpoint
