// SPDX-License-Identifier: BSD-3-Clause
// The owners of descriptors among several programs of a process: a program's descriptors are closed at its end.
#pragma once

namespace waitpoint::posix {

struct Program;

/// Descriptors from this number on count as outside, and have no owner.
inline constexpr int known_descriptors_max = 65536;

/// Makes the running program the owner, if it is one of several in the process.
void note_owner(int descriptor);
/// The descriptor has no owner from now on; numbers out of range are ignored.
void clear_owner(int descriptor);
/// The first descriptor, from `from` on, with an owner among several programs; -1 without one.
int next_owned(int from, const Program*& owner);

}  // namespace waitpoint::posix
