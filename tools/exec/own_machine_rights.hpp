// SPDX-License-Identifier: BSD-3-Clause
// The rights with which a run's first process makes a machine of its own (fibers/posix/exec/own_machine.hpp).
#pragma once

namespace waitpoint::tools {

/// Before programs are started: gives this process, and those that it starts, these rights, in a user namespace in
/// which all users are as before, unless it has them. BadInput if the system does not allow it.
void take_rights_for_own_machine();

}  // namespace waitpoint::tools
