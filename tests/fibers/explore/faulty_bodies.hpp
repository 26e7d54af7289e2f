// SPDX-License-Identifier: BSD-3-Clause
// Bodies that some schedules fail, for tests of what is said of them.
#pragma once

namespace waitpoint::faulty {

/// Three tasks count by load and store: an increment may be lost. Fails below `least`.
void count_to_three(int least);

/// The consumer looks for the letter and waits for it in two steps; between them it is not heard.
void lose_a_wake_up();

}  // namespace waitpoint::faulty
