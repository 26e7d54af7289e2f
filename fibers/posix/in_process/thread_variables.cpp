// SPDX-License-Identifier: BSD-3-Clause
//
// By this call, the compiled code of a program registers destructors of thread_local variables.
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/in_process/loaded_program.hpp"
#include "fibers/posix/threads/variables.hpp"

using namespace waitpoint::posix;

extern "C" int __cxa_thread_atexit_impl(void (*function)(void*), void* argument, void* object);

WAITPOINT_INTERPOSED int __cxa_thread_atexit_impl(void (*function)(void*), void* argument, void* object) {
  if (!runs_in_loaded_program()) return WAITPOINT_NEXT(__cxa_thread_atexit_impl)(function, argument, object);
  return add_destructor(function, argument) ? 0 : -1;
}
