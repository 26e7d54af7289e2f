// SPDX-License-Identifier: BSD-3-Clause
// Options of one command that name files: no two of them may name the same one.
#pragma once

#include <string>
#include <vector>

namespace waitpoint::tools {

struct NamedFile {
  const char* option;
  std::string name;  ///< empty where the option was not given
  enum class Use { written, read } use = Use::written;
};

/// A file takes its name when it is complete: of two with one name the first would be lost, and so would be an input.
/// Throws BadInput, which names both options. Links are followed; /dev/null and pipes may be written more than once.
void check_distinct(const std::vector<NamedFile>& files);

}  // namespace waitpoint::tools
