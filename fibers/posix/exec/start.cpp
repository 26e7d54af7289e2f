// SPDX-License-Identifier: BSD-3-Clause
//
// The start of a program: main() becomes the first thread of the simulation.
#include <cstdlib>

#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/exec/run.hpp"
#include "fibers/posix/members/members.hpp"

namespace waitpoint::posix {
namespace {

using StartMain = int (*)(Main, int, char**, void (*)(), void (*)(), void (*)(), void*);

struct Call {
  Main main;
  int argc;
  char** argv;
  char** environment;
};
Call call;

int call_program() { return call.main(call.argc, call.argv, call.environment); }

// The C library calls it in place of main(), after all constructors.
int begin_with_main(int argc, char** argv, char** environment) {
  call.argc = argc;
  call.argv = argv;
  call.environment = environment;
  if (has_members()) run_members(argc, argv);
  run_program(call_program, argc > 0 ? argv[0] : "program");
}

}  // namespace
}  // namespace waitpoint::posix

using namespace waitpoint::posix;

WAITPOINT_INTERPOSED int __libc_start_main(Main main, int argc, char** argv, void (*init)(), void (*fini)(),
                                           void (*rtld_fini)(), void* stack_end) {
  static constinit StartMain known = nullptr;
  // Called by the entry point of an executable that is one of several programs.
  if (runs_in_member()) std::exit(call_main(this_member().image, main, argc, argv));
  call.main = main;
  return next(known, "__libc_start_main")(begin_with_main, argc, argv, init, fini, rtld_fini, stack_end);
}
