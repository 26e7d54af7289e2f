// SPDX-License-Identifier: BSD-3-Clause
// The environment of a program that is one of several: its getenv(), setenv() and similar, and its `environ`.
#pragma once

#include <cstddef>

namespace waitpoint::posix {

class Environment {
 public:
  /// Begins as a copy of `from`; false without memory.
  bool begin(char** from);
  /// Frees all that it has made.
  void forget();

  /// The program's variable `environ`, which it may set itself.
  char** variables = nullptr;

  /// The value of a variable; null without it.
  char* find(const char* name) const;
  // As the C library's calls; an error number or 0.
  int set(const char* name, const char* value, bool replace);
  int put(char* text);
  int remove(const char* name);
  void clear();

 private:
  struct Text;

  /// The place of a variable among `variables`; null without it.
  char** place_of(const char* name, std::size_t length) const;
  bool place(char* text, std::size_t length);
  bool own(std::size_t room);

  char** own_ = nullptr;  ///< room for variables
  std::size_t room_ = 0;
  Text* texts_ = nullptr;  ///< that it has made: the program may hold pointers to each
};

}  // namespace waitpoint::posix
