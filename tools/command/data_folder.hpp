// SPDX-License-Identifier: BSD-3-Clause
// Installation folders of the library's data files. The build generates the source.
#pragma once

namespace waitpoint::tools {

/// An absolute path: PREFIX/share/waitpoint.
extern const char* const data_folder;
/// For libraries loaded by name: PREFIX/lib.../waitpoint.
extern const char* const library_folder;

}  // namespace waitpoint::tools
