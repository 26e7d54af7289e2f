// SPDX-License-Identifier: BSD-3-Clause
// Bodies that fail in some schedules, for tests of the reports.
#pragma once

namespace waitpoint::faulty {

/// Three tasks increment by load and store: an increment may be lost. Fails below `least`.
void count_to_three(int least);

/// The consumer tests for the letter and waits for it in two critical sections; a notification between them is lost.
void lose_a_wake_up();

}  // namespace waitpoint::faulty
