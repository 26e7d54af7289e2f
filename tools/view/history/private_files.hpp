// SPDX-License-Identifier: BSD-3-Clause
// The open files of a forked process, which it shares with its parent: what it reads would be missing there, what it
// writes would be there twice.
#pragma once

namespace waitpoint::tools::view {

/// From now on, files that are read are this process's own, at the same place; all others, standard output and error
/// among them, are /dev/null. The descriptor `kept` stays as it is.
void make_files_private(int kept);

}  // namespace waitpoint::tools::view
