// SPDX-License-Identifier: BSD-3-Clause
#include "tools/output/output_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <ctime>

#include "core/error.hpp"

namespace waitpoint::tools {
namespace {

namespace fs = std::filesystem;

/// The permissions of a new file; reading the mask requires setting it.
mode_t usual_mode() {
  const mode_t mask = umask(0);
  umask(mask);
  return 0666 & ~mask;
}

// A temporary file between its making and its lock has none either.
constexpr std::chrono::seconds leftover_age_min(10);

constexpr std::string_view mark = ".waitpoint-";

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

void remove_leftovers(const fs::path& target) {
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  const std::string prefix = target.filename().string() + std::string(mark);
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    if (at->path().filename().string().starts_with(prefix) && is_leftover(at->path())) unlink(at->path().c_str());
}

}  // namespace

void OutputFile::fail() const {
  throw BadInput(path_.string(), std::string("cannot be written: ") + std::strerror(errno));
}

OutputFile::OutputFile(const fs::path& path) : path_(path == "-" ? fs::path("/dev/stdout") : path), target_(path_) {
  std::error_code error;
  if (fs::is_directory(path_, error)) throw BadInput(path_.string(), "cannot be written: it is a folder");
  if (fs::exists(path_, error)) {
    if (access(path_.c_str(), W_OK) != 0) fail();
    if (!fs::is_regular_file(path_, error)) {
      stream_.reset(std::fopen(path_.c_str(), "we"));
      if (!stream_) fail();
      return;
    }
    // Through a link, the target is replaced, not the link.
    target_ = fs::canonical(path_, error);
    if (error) target_ = path_;
  }
  remove_leftovers(target_);
  std::string pattern = target_.string() + std::string(mark) + "XXXXXX";
  const int descriptor = mkostemp(pattern.data(), O_CLOEXEC);
  if (descriptor < 0) fail();
  temporary_ = pattern;
  flock(descriptor, LOCK_EX | LOCK_NB);
  fchmod(descriptor, usual_mode());
  stream_.reset(fdopen(descriptor, "w"));
  if (!stream_) fail();
}

OutputFile::~OutputFile() {
  std::error_code ignored;
  if (!temporary_.empty()) fs::remove(temporary_, ignored);
}

void OutputFile::write(std::string_view text) {
  WAITPOINT_CHECK(stream_ != nullptr, "a file is written after its commit");
  if (std::fwrite(text.data(), 1, text.size(), stream_.get()) != text.size()) fail();
}

void OutputFile::commit() {
  WAITPOINT_CHECK(stream_ != nullptr, "a file is committed twice");
  // Some file systems report that they are full only at the closing. The lock is kept until the file has its name.
  const int locked = dup(fileno(stream_.get()));
  const bool is_written = std::fclose(stream_.release()) == 0;
  const bool is_named = is_written && (temporary_.empty() || std::rename(temporary_.c_str(), target_.c_str()) == 0);
  const int reason = errno;
  if (locked >= 0) close(locked);
  errno = reason;
  if (!is_named) fail();
  temporary_.clear();
}

void flush_standard_output() {
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) throw BadInput("standard output", "cannot be written");
}

}  // namespace waitpoint::tools
