// SPDX-License-Identifier: BSD-3-Clause
// The command `waitpoint genom FILE.gen`: a module of modules/genom from its description in GenoM's language.
#pragma once

#include <string>
#include <vector>

#include "tools/command/command.hpp"

namespace waitpoint::tools {

struct GenomOptions {
  std::string file;
  std::string out;                   ///< the folder of the files; "": that of `file`
  std::vector<std::string> folders;  ///< of included files, beside that of `file`
  bool documentation_only = false;   ///< to standard output
  bool check_only = false;
  bool json = false;  ///< what was written as JSON to standard output
};

/// The command with its options.
void declare(Command& command, GenomOptions& options);

/// Writes the files: server/ anew, and of codels/, MODULE.yaml, Makefile those that do not exist. BadInput for a wrong
/// description, before anything is written.
int genom(const GenomOptions& options);

}  // namespace waitpoint::tools
