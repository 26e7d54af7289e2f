// SPDX-License-Identifier: BSD-3-Clause
#include "tools/output/output_file.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <utility>

#include "core/error.hpp"
#include "core/file_list.hpp"

namespace waitpoint::tools {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t buffer_size = std::size_t{64} * 1024;

// A temporary file between its making and its lock has none either.
constexpr std::chrono::seconds leftover_age_min(10);

constexpr std::string_view mark = ".waitpoint-";

// The forked copy that has taken over; not its own children, which have other numbers.
pid_t heir = 0;

/// Calls until no signal interrupts.
template <class Call>
auto retried(Call call) {
  auto result = call();
  while (result < 0 && errno == EINTR) result = call();
  return result;
}

/// Waits until a descriptor that does not block takes data, or fails for another reason. False with errno.
bool wait_writable(int descriptor) {
  pollfd waiting{.fd = descriptor, .events = POLLOUT, .revents = 0};
  return retried([&] { return poll(&waiting, 1, -1); }) >= 0;
}

/// False with errno if not all could be written. Waits where the descriptor does not: standard output may be shared
/// with a process that made it so.
bool write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = retried([&] { return ::write(descriptor, bytes.data(), bytes.size()); });
    if (written == 0) errno = EIO;  // no error by POSIX, yet no progress
    if (written > 0) {
      bytes.remove_prefix(static_cast<std::size_t>(written));
    } else if (written == 0 || (errno != EAGAIN && errno != EWOULDBLOCK) || !wait_writable(descriptor)) {
      return false;
    }
  }
  return true;
}

/// False with errno if the system reports an error of an earlier write. The descriptor is closed in any case, also when
/// a signal interrupts.
bool close_checked(int descriptor) { return close(descriptor) == 0 || errno == EINTR; }

// True if no process writes the file any more.
bool is_leftover(const fs::path& file) {
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (descriptor < 0) return false;
  struct stat status {};
  const bool is_old = fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) &&
                      std::time(nullptr) - status.st_mtime >= leftover_age_min.count();
  const bool is_unlocked = is_old && flock(descriptor, LOCK_EX | LOCK_NB) == 0;
  close(descriptor);
  return is_unlocked;
}

bool is_number(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

/// PROCESS-NUMBER, the end of a temporary file's name.
bool is_process_and_number(std::string_view text) {
  const std::size_t dash = text.find('-');
  return dash != std::string_view::npos && is_number(text.substr(0, dash)) && is_number(text.substr(dash + 1));
}

void remove_leftovers(const fs::path& target) {
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  const std::string prefix = target.filename().string() + std::string(mark);
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    const std::string name = at->path().filename().string();
    if (name.starts_with(prefix) && is_process_and_number(std::string_view(name).substr(prefix.size())) &&
        is_leftover(at->path()))
      unlink(at->path().c_str());
  }
}

[[noreturn]] void fail_writing(const std::string& name) {
  throw BadInput(name, std::string("cannot be written: ") + std::strerror(errno));
}

}  // namespace

void OutputFile::fail() const { fail_writing(name_); }

void OutputFile::take_over() { heir = getpid(); }

bool OutputFile::is_own() const {
  const pid_t self = getpid();
  return self == process_ || self == heir;
}

OutputFile::OutputFile(const fs::path& path) : name_(path.string()), target_(path), process_(getpid()) {
  if (is_standard_output(path)) {
    name_ = "standard output";
    descriptor_ = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0);
    if (descriptor_ < 0) fail();
    return;
  }
  std::error_code error;
  if (fs::is_directory(path, error)) throw BadInput(name_, "cannot be written: it is a folder");
  if (fs::exists(path, error)) {
    if (access(path.c_str(), W_OK) != 0) fail();
    if (!fs::is_regular_file(path, error)) {
      descriptor_ = retried([&] { return open(path.c_str(), O_WRONLY | O_CLOEXEC); });
      if (descriptor_ < 0) fail();
      return;
    }
    // Through a link, the target is replaced, not the link.
    target_ = fs::canonical(path, error);
    if (error) target_ = path;
  }
  FileList::add_output(path);
  remove_leftovers(target_);
  open_temporary();
}

// With the permissions of a new file. A name is taken if a process of the same number, of another machine or container,
// writes there, too.
void OutputFile::open_temporary() {
  constexpr int attempts_max = 1000;
  std::string name;
  for (int attempt = 0; descriptor_ < 0 && attempt < attempts_max; ++attempt) {
    name = target_.string() + std::string(mark) + std::to_string(getpid()) + "-" + std::to_string(attempt);
    descriptor_ = retried([&] { return open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666); });
    if (descriptor_ < 0 && errno != EEXIST) break;
  }
  if (descriptor_ < 0) fail();
  temporary_ = name;
  // On a file system without locks no leftovers are found either.
  static_cast<void>(flock(descriptor_, LOCK_EX | LOCK_NB));
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : name_(std::move(other.name_)),
      target_(std::move(other.target_)),
      temporary_(std::exchange(other.temporary_, {})),
      buffer_(std::move(other.buffer_)),
      process_(other.process_),
      descriptor_(std::exchange(other.descriptor_, -1)),
      error_(other.error_) {}

OutputFile::~OutputFile() {
  if (!temporary_.empty() && is_own()) unlink(temporary_.c_str());
  if (descriptor_ >= 0) close(descriptor_);
}

void OutputFile::write(std::string_view text) {
  WAITPOINT_CHECK(descriptor_ >= 0, "a file is written after its commit");
  buffer_ += text;
  if (buffer_.size() >= buffer_size) flush();
}

void OutputFile::flush() {
  if (error_ == 0 && is_own() && !write_all(descriptor_, buffer_)) error_ = errno;
  buffer_.clear();
}

void OutputFile::show() {
  if (!temporary_.empty()) FileList::add_output(target_);
  flush();
  errno = error_;
  if (error_ != 0 || (!temporary_.empty() && !rename_temporary())) fail();
}

bool OutputFile::rename_temporary() {
  if (retried([&] { return std::rename(temporary_.c_str(), target_.c_str()); }) != 0) return false;
  temporary_.clear();
  return true;
}

void OutputFile::commit() {
  WAITPOINT_CHECK(descriptor_ >= 0, "a file is committed twice");
  if (!is_own()) {
    close(std::exchange(descriptor_, -1));
    temporary_.clear();
    return;
  }
  if (!temporary_.empty()) FileList::add_output(target_);  // it may have been read since
  flush();
  errno = error_;
  if (error_ != 0) fail();
  // Some file systems report that they are full only at the closing. The lock is kept until the file has its name.
  const int locked = temporary_.empty() ? -1 : fcntl(descriptor_, F_DUPFD_CLOEXEC, 0);
  const bool is_written = close_checked(std::exchange(descriptor_, -1));
  const bool is_named = is_written && (temporary_.empty() || rename_temporary());
  const int reason = errno;
  if (locked >= 0) close(locked);
  errno = reason;
  if (!is_named) fail();
}

bool is_standard_output(const fs::path& path) { return path == "-" || path == "/dev/stdout"; }

void write_standard_output(std::string_view text) {
  flush_standard_output();
  if (!write_all(STDOUT_FILENO, text)) fail_writing("standard output");
}

void flush_standard_output() {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  if (errno != 0) fail_writing("standard output");
  throw BadInput("standard output", "cannot be written");
}

}  // namespace waitpoint::tools
