// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/signals/abort.hpp"

#include <gnu/libc-version.h>
#include <signal.h>

#include <cstring>

#include "fibers/posix/signals/signals.hpp"

namespace waitpoint::posix {
namespace {

/// The C library calls a handler of SIGABRT although it is blocked, up to its release 2.40.
bool abort_unblocks() { return strverscmp(gnu_get_libc_version(), "2.41") < 0; }

}  // namespace

void raise_abort() {
  if (abort_unblocks()) this_thread().blocked &= ~only(SIGABRT);
  const struct sigaction& action = this_program().signals.actions[SIGABRT];
  if ((action.sa_flags & SA_SIGINFO) != 0 || (action.sa_handler != SIG_IGN && action.sa_handler != SIG_DFL))
    raise(SIGABRT);
}

}  // namespace waitpoint::posix
