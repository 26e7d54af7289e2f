// SPDX-License-Identifier: BSD-3-Clause
// Files in the folder of a process in /proc.
#pragma once

#include "fibers/posix/files/process_paths.hpp"
#include "fibers/posix/files/text_file.hpp"

namespace waitpoint::posix {

/// Writes the text in place of the file; false for files that are the system's.
bool write_process_file(const ProcessPath& path, TextFile& text);

}  // namespace waitpoint::posix
