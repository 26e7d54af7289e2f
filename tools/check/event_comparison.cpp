// SPDX-License-Identifier: BSD-3-Clause
#include "tools/check/event_comparison.hpp"

#include "fibers/kernel/run_window.hpp"

namespace waitpoint::tools {
namespace {

LoggedEvent described(const kernel::EventRecord& record) {
  const EventName name = name_of(record);
  return {record.time, name.robot,
          name.task,   kernel::name(record.operation),
          name.object, record.task->robot->digest.value()};
}

}  // namespace

EventComparison::EventComparison(int log, void (*started)(const kernel::Task&))
    : Watch{&EventComparison::compare}, log_(log), started_(started), shared_(log) {
  shared_->equal = 0;
}

bool EventComparison::equal(const LogEntry& expected, const kernel::EventRecord& record) {
  const auto [number, is_new] = names_.number_of(record);
  return expected.time_ns == record.time.ns() && expected.name == number &&
         expected.operation == static_cast<std::uint8_t>(record.operation) &&
         expected.digest == record.task->robot->digest.value() && (!is_new || log_.name(number) == name_of(record));
}

void EventComparison::compare(kernel::Watch& watch, const kernel::EventRecord& record) {
  EventComparison& self = static_cast<EventComparison&>(watch);
  if (self.parted() || self.failure_ != nullptr) return;
  if (self.started_ != nullptr && record.operation == kernel::Operation::start) self.started_(*record.task);
  try {
    const LogEntry* const expected = self.log_.next();
    if (expected != nullptr && self.equal(*expected, record)) {
      self.log_.keep_latest(*expected);
      self.latest_ = *expected;
      ++self.shared_->equal;
      return;
    }
    Difference& difference = self.difference_.emplace();
    difference.number = self.shared_->equal + 1;
    difference.found = described(record);
    difference.before = self.log_.latest(difference.found->robot);
    difference.expected_end = self.log_.end();
    if (expected != nullptr) difference.expected = self.log_.described(*expected);
  } catch (...) {
    self.failure_ = std::current_exception();
  }
  kernel::pause(*record.task->scheduler);
}

std::optional<Difference> EventComparison::finish(const Digest& digest, const std::string& end) {
  if (failure_ != nullptr) std::rethrow_exception(failure_);
  if (parted()) return difference_;
  const LogEntry* const expected = log_.next();
  if (expected == nullptr && digest.value() == log_.digest() && end == log_.end()) return std::nullopt;
  Difference& difference = difference_.emplace();
  difference.number = shared_->equal + 1;
  difference.expected_end = log_.end();
  difference.found_end = end;
  if (expected != nullptr) {
    difference.expected = log_.described(*expected);
    difference.before = log_.latest(difference.expected->robot);
  } else if (latest_) {
    difference.before = log_.described(*latest_);
  }
  return difference_;
}

Difference cut_off(int log, std::uint64_t equal, const std::string& end) {
  EventLogReader reader(log);
  Difference difference;
  difference.number = equal + 1;
  difference.found_end = end;
  const LogEntry* entry = reader.next();
  std::optional<LogEntry> before;
  for (std::uint64_t i = 0; i < equal && entry != nullptr; ++i, entry = reader.next()) before = *entry;
  if (before) difference.before = reader.described(*before);
  difference.expected_end = reader.end();
  if (entry != nullptr) difference.expected = reader.described(*entry);
  return difference;
}

}  // namespace waitpoint::tools
