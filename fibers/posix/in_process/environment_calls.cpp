// SPDX-License-Identifier: BSD-3-Clause
//
// The environment of a program. What the C library itself reads, such as TZ, is the process's.
#include <cerrno>
#include <cstdlib>

#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/in_process/loaded_program.hpp"

namespace waitpoint::posix {
namespace {

Environment& own_environment() { return this_loaded_program().image.environment; }

int result_of(int error) { return error == 0 ? 0 : fail(error); }

}  // namespace
}  // namespace waitpoint::posix

using namespace waitpoint::posix;

WAITPOINT_INTERPOSED char* getenv(const char* name) noexcept {
  return runs_in_loaded_program() ? own_environment().find(name) : WAITPOINT_NEXT(getenv)(name);
}
WAITPOINT_INTERPOSED char* secure_getenv(const char* name) noexcept {
  return runs_in_loaded_program() ? own_environment().find(name) : WAITPOINT_NEXT(secure_getenv)(name);
}
WAITPOINT_INTERPOSED int setenv(const char* name, const char* value, int replace) noexcept {
  if (!runs_in_loaded_program()) return WAITPOINT_NEXT(setenv)(name, value, replace);
  return result_of(own_environment().set(name, value, replace != 0));
}
WAITPOINT_INTERPOSED int putenv(char* text) noexcept {
  return runs_in_loaded_program() ? result_of(own_environment().put(text)) : WAITPOINT_NEXT(putenv)(text);
}
WAITPOINT_INTERPOSED int unsetenv(const char* name) noexcept {
  return runs_in_loaded_program() ? result_of(own_environment().remove(name)) : WAITPOINT_NEXT(unsetenv)(name);
}
WAITPOINT_INTERPOSED int clearenv() noexcept {
  if (!runs_in_loaded_program()) return WAITPOINT_NEXT(clearenv)();
  own_environment().clear();
  return 0;
}
