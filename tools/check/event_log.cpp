// SPDX-License-Identifier: BSD-3-Clause
#include "tools/check/event_log.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "core/error.hpp"

namespace waitpoint::tools {
namespace {

constexpr std::size_t buffer_size = 1 << 16;
// Names may contain spaces.
constexpr char separator = '\n';

[[noreturn]] void refuse(const std::string& what, int error) {
  throw BadInput("--verify", what + ": " + std::strerror(error));
}

int temporary_file() {
  std::error_code ignored;
  std::filesystem::path folder = std::filesystem::temp_directory_path(ignored);
  if (ignored) folder = "/tmp";
  std::string name = (folder / "waitpoint-check-XXXXXX").string();
  const int file = mkostemp(name.data(), O_CLOEXEC);
  if (file < 0) refuse("cannot create a temporary file in '" + folder.string() + "'", errno);
  unlink(name.c_str());
  return file;
}

}  // namespace

SharedMapping::SharedMapping(int file) {
  void* const page = mmap(nullptr, SharedPage::size, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  if (page == MAP_FAILED) refuse("the temporary file of events cannot be mapped", errno);
  page_ = static_cast<SharedPage*>(page);
}

SharedMapping::~SharedMapping() { munmap(page_, SharedPage::size); }

EventLog::EventLog() : Watch{&EventLog::write}, file_(temporary_file()) {
  buffer_.reserve(buffer_size);
  if (ftruncate(file_, SharedPage::size) != 0 || lseek(file_, SharedPage::size, SEEK_SET) < 0) error_ = errno;
}

EventLog::~EventLog() { close(file_); }

void EventLog::flush() {
  for (std::size_t done = 0; done < buffer_.size() && error_ == 0;) {
    const ssize_t written = ::write(file_, buffer_.data() + done, buffer_.size() - done);
    if (written >= 0) {
      done += static_cast<std::size_t>(written);
    } else if (errno != EINTR) {
      error_ = errno;
    }
  }
  buffer_.clear();
}

void EventLog::put(const void* data, std::size_t size) {
  if (buffer_.size() + size > buffer_size) flush();
  buffer_.insert(buffer_.end(), static_cast<const char*>(data), static_cast<const char*>(data) + size);
}

void EventLog::write(kernel::Watch& watch, const kernel::EventRecord& record) {
  EventLog& self = static_cast<EventLog&>(watch);
  const auto [number, is_new] = self.names_.number_of(record);
  LogEntry entry;
  if (is_new) {
    const EventName name = name_of(record);
    const std::string text = name.robot + separator + name.task + separator + name.object;
    entry.kind = LogEntry::Kind::name;
    entry.name = static_cast<std::uint32_t>(text.size());
    self.put(entry);
    self.put(text.data(), text.size());
  }
  entry.kind = LogEntry::Kind::event;
  entry.name = number;
  entry.operation = static_cast<std::uint8_t>(record.operation);
  entry.time_ns = record.time.ns();
  entry.digest = record.task->robot->digest.value();
  self.put(entry);
}

void EventLog::finish(const Digest& digest, const std::string& end) {
  LogEntry entry;
  entry.kind = LogEntry::Kind::end;
  entry.name = static_cast<std::uint32_t>(end.size());
  entry.digest = digest.value();
  put(entry);
  put(end.data(), end.size());
  flush();
  if (error_ != 0) refuse("the temporary file of events cannot be written", error_);
}

void EventLogReader::read(void* data, std::size_t size) {
  for (char* to = static_cast<char*>(data); size > 0;) {
    if (used_ == buffer_.size()) {
      buffer_.resize(buffer_size);
      const ssize_t got = pread(file_, buffer_.data(), buffer_.size(), at_);
      if (got < 0) refuse("the temporary file of events cannot be read", errno);
      if (got == 0) throw BadInput("--verify", "the temporary file of events ends early");
      buffer_.resize(static_cast<std::size_t>(got));
      at_ += got;
      used_ = 0;
    }
    const std::size_t part = std::min(size, buffer_.size() - used_);
    std::memcpy(to, buffer_.data() + used_, part);
    used_ += part;
    to += part;
    size -= part;
  }
}

void EventLogReader::take_name(const std::string& text) {
  const std::size_t first = text.find(separator), second = text.find(separator, first + 1);
  const EventName name{text.substr(0, first), text.substr(first + 1, second - first - 1), text.substr(second + 1)};
  const auto robot = std::find(robots_.begin(), robots_.end(), name.robot);
  names_.push_back({name, static_cast<std::size_t>(robot - robots_.begin())});
  if (robot != robots_.end()) return;
  robots_.push_back(name.robot);
  latest_.emplace_back();
}

const LogEntry* EventLogReader::next() {
  for (;;) {
    read(&entry_, sizeof entry_);
    if (entry_.kind == LogEntry::Kind::event) return &entry_;
    std::string text(entry_.name, '\0');
    read(text.data(), text.size());
    if (entry_.kind == LogEntry::Kind::end) {
      digest_ = entry_.digest;
      end_ = text;
      return nullptr;
    }
    take_name(text);
  }
}

LoggedEvent EventLogReader::described(const LogEntry& entry) const {
  const EventName& of = name(entry.name);
  return {Time() + Duration::from_ns(entry.time_ns),
          of.robot,
          of.task,
          kernel::name(static_cast<kernel::Operation>(entry.operation)),
          of.object,
          entry.digest};
}

std::optional<LoggedEvent> EventLogReader::latest(const std::string& robot) const {
  const auto at = std::find(robots_.begin(), robots_.end(), robot);
  if (at == robots_.end()) return std::nullopt;
  const std::optional<LogEntry>& entry = latest_[static_cast<std::size_t>(at - robots_.begin())];
  return entry ? std::optional(described(*entry)) : std::nullopt;
}

}  // namespace waitpoint::tools
