// SPDX-License-Identifier: BSD-3-Clause
// State of the process that code of modules shares with all other code: the floating-point environment, the locale, the
// signal mask, the standard streams and their descriptors, the current folder and the mask of permissions.
//
// After a module's constructor or destructor, or the loading of a library, it is as before; a change is reported once
// with the phase that made it:
//
//   waitpoint: warning: constructing module ndd of robot rackham changes rounding of floating-point numbers, the
//   locale; restored
//
// Codels have the standard floating-point environment, since a comparison costs nothing measurable. The rest is
// compared after each codel where a run is verified.
#pragma once

#include <sys/stat.h>

#include <array>
#include <clocale>
#include <csignal>
#include <ios>
#include <locale>
#include <string>
#include <vector>

#include "core/float_environment.hpp"

namespace waitpoint {

/// The values at its construction, in this thread.
class ProcessState {
 public:
  ProcessState();
  ~ProcessState();
  ProcessState(const ProcessState&) = delete;
  ProcessState& operator=(const ProcessState&) = delete;

  /// Restores them; returns the changed ones in words.
  std::vector<std::string> restore() const;

 private:
  struct Stream {
    int duplicate = -1;  // -1: the stream is closed
    int flags = 0;
    struct stat file {};
  };
  static constexpr int streams_count = 3;

  bool restore_locale() const;
  bool restore_signal_mask() const;
  bool restore_descriptors() const;
  bool restore_streams() const;
  bool restore_folder() const;
  bool restore_permissions() const;

  std::string locale_;
  std::locale of_streams_;
  locale_t of_thread_;
  sigset_t signals_{};
  std::array<Stream, streams_count> descriptors_;
  std::array<std::ios, streams_count> formats_{std::ios(nullptr), std::ios(nullptr), std::ios(nullptr)};
  std::array<std::streambuf*, streams_count> buffers_{};
  int folder_;
  struct stat of_folder_ {};
  mode_t permissions_;
};

/// A phase of module code outside of tasks.
class ProcessStateKept {
 public:
  /// "constructing module ndd of robot rackham"; must outlive the object.
  explicit ProcessStateKept(const char* phase) : phase_(phase) {}
  ~ProcessStateKept();
  ProcessStateKept(const ProcessStateKept&) = delete;
  ProcessStateKept& operator=(const ProcessStateKept&) = delete;

 private:
  const char* phase_;
  const ProcessState before_;
};

/// While it lives, the surroundings of its construction are restored after each codel, too. Not two at a time.
class CodelsChecked {
 public:
  CodelsChecked();
  ~CodelsChecked();
  CodelsChecked(const CodelsChecked&) = delete;
  CodelsChecked& operator=(const CodelsChecked&) = delete;

  static const ProcessState* standard() { return standard_; }

 private:
  const ProcessState before_;
  static inline const ProcessState* standard_ = nullptr;
};

/// Reports once that `phase` changed something, which was restored. Few distinct reports are written in a process.
void report_changed_surroundings(const std::string& phase, const std::vector<std::string>& changed);

/// After a codel, and before a task's first one. `phase()` makes the words.
template <class Phase>
void restore_after_codel(Phase phase) {
  if (__builtin_expect(FloatEnvironment::is_standard() && CodelsChecked::standard() == nullptr, 1)) return;
  std::vector<std::string> changed;
  if (std::string floats = FloatEnvironment::restore_standard(); !floats.empty()) changed.push_back(std::move(floats));
  if (CodelsChecked::standard() != nullptr)
    for (std::string& each : CodelsChecked::standard()->restore()) changed.push_back(std::move(each));
  if (!changed.empty()) report_changed_surroundings(phase(), changed);
}

}  // namespace waitpoint
