// SPDX-License-Identifier: BSD-3-Clause
#include "core/process_state.hpp"

#include <fcntl.h>
#include <pthread.h>
#include <unistd.h>

#include <cstdio>
#include <iostream>
#include <mutex>
#include <set>

#include "core/spin_lock.hpp"

namespace waitpoint {
namespace {

constexpr int first_free = STDERR_FILENO + 1;

std::array<std::ios*, 3> streams() { return {&std::cout, &std::cerr, &std::clog}; }

bool is_same_file(const struct stat& one, const struct stat& other) {
  return one.st_dev == other.st_dev && one.st_ino == other.st_ino && one.st_rdev == other.st_rdev;
}

/// A descriptor of the stream's file, from which it can be restored. One for each stream serves for the life of the
/// process: to close a duplicate may fail with the error of an output, as to close the stream.
int duplicate_of(int stream, const struct stat& file) {
  static SpinLock lock;
  static constinit int duplicates[] = {-1, -1, -1};
  const std::lock_guard guard(lock);
  int& duplicate = duplicates[stream];
  struct stat of_duplicate {};
  if (duplicate >= 0 && fstat(duplicate, &of_duplicate) == 0 && is_same_file(of_duplicate, file)) return duplicate;
  if (duplicate >= 0) close(duplicate);
  return duplicate = fcntl(stream, F_DUPFD_CLOEXEC, first_free);
}

// The system has no call that only reads it.
mode_t present_permissions() {
  const mode_t mask = umask(0);
  umask(mask);
  return mask;
}

}  // namespace

ProcessState::ProcessState()
    : locale_(std::setlocale(LC_ALL, nullptr)),
      of_thread_(uselocale(nullptr)),
      folder_(open(".", O_PATH | O_DIRECTORY | O_CLOEXEC)),
      permissions_(present_permissions()) {
  pthread_sigmask(SIG_SETMASK, nullptr, &signals_);
  for (int i = 0; i < streams_count; ++i) {
    Stream& stream = descriptors_[static_cast<std::size_t>(i)];
    if (fstat(i, &stream.file) == 0) stream.duplicate = duplicate_of(i, stream.file);
    stream.flags = fcntl(i, F_GETFL);
    formats_[static_cast<std::size_t>(i)].copyfmt(*streams()[static_cast<std::size_t>(i)]);
    buffers_[static_cast<std::size_t>(i)] = streams()[static_cast<std::size_t>(i)]->rdbuf();
  }
  if (folder_ >= 0) fstat(folder_, &of_folder_);
}

ProcessState::~ProcessState() {
  if (folder_ >= 0) close(folder_);
}

std::vector<std::string> ProcessState::restore() const {
  std::vector<std::string> changed;
  const auto add = [&changed](bool is_changed, const char* words) {
    if (is_changed) changed.emplace_back(words);
  };
  if (std::string floats = FloatEnvironment::restore_standard(); !floats.empty()) changed.push_back(std::move(floats));
  add(restore_locale(), "the locale");
  add(restore_signal_mask(), "the signal mask");
  add(restore_descriptors(), "the descriptors of the standard streams");
  add(restore_streams(), "the formats of the standard streams");
  add(restore_folder(), "the current folder");
  add(restore_permissions(), "the mask of permissions (umask)");
  return changed;
}

// That of the C++ library sets the C library's.
bool ProcessState::restore_locale() const {
  bool is_changed = false;
  if (std::locale() != of_streams_) std::locale::global(of_streams_), is_changed = true;
  if (locale_ != std::setlocale(LC_ALL, nullptr)) std::setlocale(LC_ALL, locale_.c_str()), is_changed = true;
  if (uselocale(nullptr) != of_thread_) uselocale(of_thread_), is_changed = true;
  return is_changed;
}

bool ProcessState::restore_signal_mask() const {
  sigset_t now;
  pthread_sigmask(SIG_SETMASK, &signals_, &now);
  for (int signal = 1; signal < _NSIG; ++signal)
    if (sigismember(&now, signal) != sigismember(&signals_, signal)) return true;
  return false;
}

bool ProcessState::restore_descriptors() const {
  bool is_changed = false;
  for (int i = 0; i < streams_count; ++i) {
    const Stream& before = descriptors_[static_cast<std::size_t>(i)];
    struct stat now {};
    const bool is_open = fstat(i, &now) == 0;
    if (is_open == (before.duplicate >= 0) && (!is_open || is_same_file(now, before.file))) {
      if (!is_open || fcntl(i, F_GETFL) == before.flags) continue;
      fcntl(i, F_SETFL, before.flags);
    } else if (before.duplicate >= 0) {
      dup2(before.duplicate, i);
    } else {
      close(i);
    }
    is_changed = true;
  }
  return is_changed;
}

bool ProcessState::restore_streams() const {
  bool is_changed = false;
  for (std::size_t i = 0; i < formats_.size(); ++i) {
    std::ios& stream = *streams()[i];
    const std::ios& before = formats_[i];
    const bool is_same = stream.flags() == before.flags() && stream.precision() == before.precision() &&
                         stream.width() == before.width() && stream.fill() == before.fill() &&
                         stream.exceptions() == before.exceptions() && stream.getloc() == before.getloc() &&
                         stream.rdbuf() == buffers_[i];
    if (is_same) continue;
    stream.rdbuf(buffers_[i]);
    stream.copyfmt(before);
    is_changed = true;
  }
  return is_changed;
}

bool ProcessState::restore_folder() const {
  struct stat now {};
  if (folder_ < 0 || (stat(".", &now) == 0 && is_same_file(now, of_folder_))) return false;
  return fchdir(folder_) == 0;
}

bool ProcessState::restore_permissions() const { return umask(permissions_) != permissions_; }

ProcessStateKept::~ProcessStateKept() {
  if (const std::vector<std::string> changed = before_.restore(); !changed.empty())
    report_changed_surroundings(phase_, changed);
}

CodelsChecked::CodelsChecked() { standard_ = &before_; }
CodelsChecked::~CodelsChecked() { standard_ = nullptr; }

void report_changed_surroundings(const std::string& phase, const std::vector<std::string>& changed) {
  constexpr std::size_t reports_max = 16;
  static SpinLock lock;
  static std::set<std::string> reports;
  std::string text = "waitpoint: warning: " + phase + " changes ";
  for (std::size_t i = 0; i < changed.size(); ++i) text += (i > 0 ? ", " : "") + changed[i];
  text += "; restored\n";
  const std::lock_guard guard(lock);
  if (reports.size() < reports_max && reports.insert(text).second) std::fputs(text.c_str(), stderr);
}

}  // namespace waitpoint
