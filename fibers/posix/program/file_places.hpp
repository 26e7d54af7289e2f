// SPDX-License-Identifier: BSD-3-Clause
// The places of files, for footprints of calls: one for a name with the contents, offsets and flags that are reached by
// it, one for the list of a folder's names. They follow from the canonical path, so they are the same in all schedules.
//
// A file with several links has all of these places; making a link, or moving a folder, changes all.
#pragma once

#include <cstdio>

#include "fibers/posix/program/state_calls.hpp"

namespace waitpoint::posix {

/// Of the file that is open there; place::channels for what is no file.
Places file_at(int descriptor);

/// Reads the file of that name, and what leads to it. A path that cannot be read leads to nothing.
EventFootprint reading_name(int folder, const char* path, bool follows_link = true);
/// Reads also the names in it, if it is a folder.
EventFootprint reading_folder(int folder, const char* path);
/// Makes, removes or changes the file of that name, which is in its folder then, or no more.
EventFootprint changing_name(int folder, const char* path);
/// Changes what it contains, or its attributes.
EventFootprint changing_file(int folder, const char* path, bool follows_link = true);
EventFootprint opening(int folder, const char* path, int flags);
EventFootprint renaming(int folder, const char* path, int to_folder, const char* to);

/// Of calls on a descriptor.
inline EventFootprint reading_at(int descriptor) { return reading(place::descriptors | file_at(descriptor)); }
inline EventFootprint changing_at(int descriptor) {
  return reading(place::descriptors) | changing(file_at(descriptor));
}

/// A stream has a place of its own.
EventFootprint changing_stream(FILE* stream);
/// Of the next entry of an open folder: changes its position.
EventFootprint reading_entries(int descriptor);

}  // namespace waitpoint::posix
