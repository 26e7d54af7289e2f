// SPDX-License-Identifier: BSD-3-Clause
// The events of one run in a temporary file, for other runs to be compared with, event by event, in this process or in
// another that has the file open.
//
//   | shared page | name | event | event | name | event | ... | end: digest, and how the run ended |
//
// A name (robot, task, object) stands before the first event that has it. 24 bytes an event on the disk, and in memory
// only the names: a long run does not fill it.
#pragma once

#include <sys/types.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fibers/sync/simulation.hpp"
#include "tools/check/difference.hpp"
#include "tools/check/event_names.hpp"

namespace waitpoint::tools {

/// As it stands in the file; the bytes of texts follow it.
struct LogEntry {
  enum class Kind : std::uint8_t { event, name, end };

  std::int64_t time_ns = 0;
  std::uint64_t digest = 0;  ///< of the robot with this event; at the end: of the run
  std::uint32_t name = 0;    ///< its number; at a name and at the end: the bytes that follow
  std::uint8_t operation = 0;
  Kind kind = Kind::event;
  std::array<std::uint8_t, 2> unused = {};
  friend bool operator==(const LogEntry&, const LogEntry&) = default;
};
static_assert(sizeof(LogEntry) == 24);

/// How far a comparison came: seen by all processes that have the file open, at once.
struct SharedPage {
  static constexpr off_t size = 4096;

  std::uint64_t equal = 0;  ///< events so far, of the latest comparison
  // Of the process that made the log, for a perturbed one to see whether it is: see perturbed_memory.hpp.
  std::int64_t calendar_s = 0;
  std::uint64_t stack = 0, heap = 0, library = 0;
  bool moved = false, surrounded = false;  ///< what the perturbed one saw
};

/// The shared page of an open log, mapped as long as this lives.
class SharedMapping {
 public:
  /// Throws BadInput if it cannot be mapped.
  explicit SharedMapping(int file);
  ~SharedMapping();
  SharedMapping(const SharedMapping&) = delete;
  SharedMapping& operator=(const SharedMapping&) = delete;
  SharedPage* operator->() const { return page_; }

 private:
  SharedPage* page_;
};

/// Writes the events of a run. Nothing of it is left on the disk when nobody has it open.
class EventLog : private kernel::Watch {
 public:
  /// In the folder for temporary files ($TMPDIR). Throws BadInput if none can be had.
  EventLog();
  ~EventLog();
  EventLog(const EventLog&) = delete;
  EventLog& operator=(const EventLog&) = delete;

  void watch(Simulation& simulation) { simulation.scheduler().set_watch(this); }
  /// After the run: its digest and how it ended. BadInput if the file could not be written.
  void finish(const Digest& digest, const std::string& end);
  /// The file's descriptor, open as long as this lives.
  int file() const { return file_; }

 private:
  static void write(kernel::Watch& watch, const kernel::EventRecord& record);
  void put(const LogEntry& entry) { put(&entry, sizeof entry); }
  void put(const void* data, std::size_t size);
  void flush();

  int file_;
  EventNames names_;
  std::vector<char> buffer_;
  int error_ = 0;  // of the first write that failed
};

/// Reads a log from its start.
class EventLogReader {
 public:
  explicit EventLogReader(int file) : file_(file) {}

  /// The next event; null at the end, whose digest and text are then known. BadInput if the file ends early.
  const LogEntry* next();
  std::uint64_t digest() const { return digest_; }
  const std::string& end() const { return end_; }

  const EventName& name(std::uint32_t number) const { return names_.at(number).name; }
  std::size_t names() const { return names_.size(); }
  LoggedEvent described(const LogEntry& entry) const;
  /// The latest event of the robot that was kept, if any.
  std::optional<LoggedEvent> latest(const std::string& robot) const;
  void keep_latest(const LogEntry& entry) { latest_[names_[entry.name].robot] = entry; }

 private:
  struct Name {
    EventName name;
    std::size_t robot;  // its place in latest_
  };
  void read(void* data, std::size_t size);
  void take_name(const std::string& text);

  int file_;
  off_t at_ = SharedPage::size;
  std::vector<char> buffer_;
  std::size_t used_ = 0;
  std::vector<Name> names_;
  std::vector<std::string> robots_;
  std::vector<std::optional<LogEntry>> latest_;  // of each robot
  LogEntry entry_;
  std::uint64_t digest_ = 0;
  std::string end_;
};

}  // namespace waitpoint::tools
