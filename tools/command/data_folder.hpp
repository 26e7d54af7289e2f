// SPDX-License-Identifier: BSD-3-Clause
// Where the files that the library needs beside itself are installed. The build writes the source.
#pragma once

namespace waitpoint::tools {

/// An absolute path: PREFIX/share/waitpoint.
extern const char* const data_folder;
/// Of libraries that are loaded by name: PREFIX/lib.../waitpoint.
extern const char* const library_folder;

}  // namespace waitpoint::tools
