// SPDX-License-Identifier: BSD-3-Clause
// `waitpoint view FINDING`: a finding of exploration in a browser, or as a page in a file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "tools/command/command_line.hpp"
#include "tools/command/serve_address.hpp"

namespace waitpoint::tools {

struct ViewOptions {
  std::filesystem::path file;
  std::optional<std::filesystem::path> page;  ///< to write
  std::optional<ServeAddress> serve;          ///< nothing: the page is only written
};

/// The arguments as text, and their definition.
class ViewArguments {
 public:
  /// Adds the command.
  explicit ViewArguments(CommandLine& line);

  /// True if the command line has this command.
  bool parsed() const { return command_.parsed(); }
  ViewOptions options() const;

 private:
  Command command_;
  std::string file_, page_, serve_;
};

/// Writes the page, or serves it until Ctrl-C; returns the exit status. BadInput for a file that is no finding.
int view_finding(const ViewOptions& options);

}  // namespace waitpoint::tools
