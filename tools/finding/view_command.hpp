// SPDX-License-Identifier: BSD-3-Clause
// `waitpoint view FINDING`: a finding of exploration in a browser, or as a page in a file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "tools/command/command.hpp"
#include "tools/command/serve_address.hpp"

namespace waitpoint::tools {

struct ViewOptions {
  std::filesystem::path file;
  std::optional<std::filesystem::path> page;  ///< to write
  std::optional<ServeAddress> serve;          ///< nothing: the page is only written
};

/// The command with its options.
void declare(Command& command, ViewOptions& options);

/// Writes the page, or serves it until Ctrl-C; returns the exit status. BadInput for a file that is no finding.
int view_finding(const ViewOptions& options);

}  // namespace waitpoint::tools
