// SPDX-License-Identifier: BSD-3-Clause
// The account that a process gives of itself when the process that watches the run asks: what its threads do, and the
// place in the program's code where the running one is.
#pragma once

namespace waitpoint::posix {

/// From now on the process answers, whatever it does at that moment.
void begin_to_answer();

}  // namespace waitpoint::posix
