// SPDX-License-Identifier: BSD-3-Clause
// The events of one run in a temporary file, to compare other runs with, event by event, in this process or another
// that has the file open.
//
//   | shared page | name | event | event | name | event | ... | end: digest, and how the run ended |
//
// A name (robot, task, object) precedes the first event that has it. An event takes 24 bytes on disk, and only names
// are in memory: long runs do not fill it.
#pragma once

#include <sys/types.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fibers/kernel/watch.hpp"
#include "fibers/sync/simulation.hpp"
#include "tools/check/difference.hpp"
#include "tools/check/event_names.hpp"

namespace waitpoint::tools {

/// The layout in the file; the bytes of texts follow.
struct LogEntry {
  enum class Kind : std::uint8_t { event, name, end };

  std::int64_t time_ns = 0;
  std::uint64_t digest = 0;  ///< of the robot, including this event; at the end: of the run
  std::uint32_t name = 0;    ///< its number; for a name and at the end: the number of bytes that follow
  std::uint8_t operation = 0;
  Kind kind = Kind::event;
  std::array<std::uint8_t, 2> unused = {};
  friend bool operator==(const LogEntry&, const LogEntry&) = default;
};
static_assert(sizeof(LogEntry) == 24);

/// Progress of a comparison, visible at once to all processes that have the file open.
struct SharedPage {
  static constexpr off_t size = 4096;

  std::uint64_t equal = 0;  ///< events so far in the latest comparison
  // Of the process that made the log; a perturbed one checks that its own differ: see perturbed_memory.hpp.
  std::int64_t calendar_s = 0;
  std::uint64_t stack = 0, heap = 0, library = 0;
  bool moved = false, surrounded = false;  ///< findings of the perturbed process
};

/// The shared page of an open log, mapped during the lifetime of this object.
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

/// Writes the events of a run. The file is unlinked: the disk space is freed with the last descriptor.
class EventLog : private kernel::Watch {
 public:
  /// In the folder for temporary files ($TMPDIR). Throws BadInput if the file cannot be created.
  EventLog();
  ~EventLog();
  EventLog(const EventLog&) = delete;
  EventLog& operator=(const EventLog&) = delete;

  void watch(Simulation& simulation) { kernel::set_watch(simulation.scheduler(), this); }
  /// After the run: its digest and its end. BadInput if the file could not be written.
  void finish(const Digest& digest, const std::string& end);
  /// The file's descriptor, open during the lifetime of this object.
  int file() const { return file_; }

 private:
  static void write(kernel::Watch& watch, const kernel::EventRecord& record);
  void put(const LogEntry& entry) { put(&entry, sizeof entry); }
  void put(const void* data, std::size_t size);
  void flush();

  int file_;
  EventNames names_;
  std::vector<char> buffer_;
  int error_ = 0;  // of the first failed write
};

/// Reads a log from its start.
class EventLogReader {
 public:
  explicit EventLogReader(int file) : file_(file) {}

  /// The next event; null at the end, when digest and text become valid. BadInput if the file ends early.
  const LogEntry* next();
  std::uint64_t digest() const { return digest_; }
  const std::string& end() const { return end_; }

  const EventName& name(std::uint32_t number) const { return names_.at(number).name; }
  std::size_t names() const { return names_.size(); }
  LoggedEvent described(const LogEntry& entry) const;
  /// The latest event kept of the robot, if any.
  std::optional<LoggedEvent> latest(const std::string& robot) const;
  void keep_latest(const LogEntry& entry) { latest_[names_[entry.name].robot] = entry; }

 private:
  struct Name {
    EventName name;
    std::size_t robot;  // index into latest_
  };
  void read(void* data, std::size_t size);
  void take_name(const std::string& text);

  int file_;
  off_t at_ = SharedPage::size;
  std::vector<char> buffer_;
  std::size_t used_ = 0;
  std::vector<Name> names_;
  std::vector<std::string> robots_;
  std::vector<std::optional<LogEntry>> latest_;  // by robot
  LogEntry entry_;
  std::uint64_t digest_ = 0;
  std::string end_;
};

}  // namespace waitpoint::tools
