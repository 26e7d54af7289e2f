// SPDX-License-Identifier: BSD-3-Clause
// /dev/random and /dev/urandom: their bytes follow from the seed, also those of a FILE*.
#pragma once

#include <cstdio>

namespace waitpoint::posix {

/// True for a descriptor of one of them.
bool gives_random(int descriptor);
/// The stream itself or, if it is of one of them, another in its place, with the same descriptor; null, with the stream
/// closed, if there is no memory.
FILE* with_own_bytes(FILE* stream, const char* mode);

}  // namespace waitpoint::posix
