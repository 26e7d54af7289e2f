// SPDX-License-Identifier: BSD-3-Clause
// The descriptors that a run has opened, whose calls are followed (followed_calls.hpp): closed when they are undone.
#pragma once

#include "fibers/posix/base/system_call_words.hpp"

namespace waitpoint::posix {

/// True for a call that opens descriptors, or uses or closes one of the run's, and does nothing else for good.
bool is_undone_by_closing(long number, const CallWords& words);
/// True if the run has opened it.
bool is_opened_since(int descriptor);
/// After the call, which has not failed.
void note_descriptors(long number, const CallWords& words, long result);
void close_descriptors_of_run();
bool has_open_descriptors_of_run();

}  // namespace waitpoint::posix
