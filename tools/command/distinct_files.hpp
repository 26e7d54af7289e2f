// SPDX-License-Identifier: BSD-3-Clause
// Options of one command that name files: the files must be distinct.
#pragma once

#include <string>
#include <vector>

namespace waitpoint::tools {

struct NamedFile {
  const char* option;
  std::string name;  ///< empty if the option was not given
  enum class Use { written, read } use = Use::written;
};

/// Files are renamed into place when complete: with a shared name the first output, or an input, would be lost. Throws
/// BadInput, naming both options. Links are followed; /dev/null and pipes may be shared.
void check_distinct(const std::vector<NamedFile>& files);

}  // namespace waitpoint::tools
