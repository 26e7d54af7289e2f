// SPDX-License-Identifier: BSD-3-Clause
// Options of one command that name files: the files must be distinct, and not what standard output is for.
#pragma once

#include <string>
#include <vector>

namespace waitpoint::tools {

struct NamedFile {
  std::string option;
  std::string name;
  enum class Use { written, read } use = Use::written;
};

/// Files are renamed into place when complete: with a shared name the first output, or an input, would be lost. Throws
/// BadInput, naming both options. Links are followed; /dev/null and pipes may be shared.
void check_distinct(const std::vector<NamedFile>& files);

/// With --json standard output is for the document alone. Throws BadInput, naming the option, if one of the written
/// files is standard output: "-", or by any name the file, pipe or terminal that it leads to. /dev/null may be shared.
void check_beside_json(const std::vector<NamedFile>& files);

}  // namespace waitpoint::tools
