// SPDX-License-Identifier: BSD-3-Clause
// Working directories of programs that share a process. The process's own is the host's; it is a program's, if that has
// changed it, while code of the program runs, not within the kernel.
#pragma once

namespace waitpoint::posix {

/// Of a program that has not changed it; else a descriptor of the directory.
inline constexpr int directory_of_process = -1;

/// Notes the host's directory, before a program first changes its own.
void keep_directory_of_process();
/// Changes the process's directory, keeping `errno`; false if that is not permitted.
bool enter_directory(int directory);
void return_to_directory_of_process();

}  // namespace waitpoint::posix
