// SPDX-License-Identifier: BSD-3-Clause
// The functions that the system maps into each process (vDSO): clock_gettime(), time() and others, without a system
// call. Programs that call them directly, and the C library's own code, see the simulation's clocks instead.
#pragma once

namespace waitpoint::posix {

/// From now on; forked children inherit it. Without an effect if the system does not let the code be replaced.
void replace_vdso();

}  // namespace waitpoint::posix
