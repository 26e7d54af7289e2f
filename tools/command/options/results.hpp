// SPDX-License-Identifier: BSD-3-Clause
// The files that commands write about their results, and the comparison of repeated runs.
#pragma once

#include <filesystem>
#include <optional>

#include "tools/command/command.hpp"

namespace waitpoint::tools {

using OptionalFile = std::optional<std::filesystem::path>;

/// --summary and --json.
void declare_summary(Command& command, OptionalFile& summary, bool& json);
/// --picture, of what `description` says.
void declare_picture(Command& command, OptionalFile& picture, const char* description, const char* former = nullptr);
/// --digests and --events; `of` are whose digests.
void declare_event_files(Command& command, OptionalFile& digests, const char* of, OptionalFile& events);
/// --trace, of what `description` says.
void declare_trace(Command& command, OptionalFile& trace, const char* description);
/// --verify, and that it writes none of `files`.
void declare_verify(Command& command, bool& verify, std::vector<std::string> files);

}  // namespace waitpoint::tools
