// SPDX-License-Identifier: BSD-3-Clause
//
// The start of a program: main() becomes the first thread of the simulation.
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/exec/run.hpp"

namespace waitpoint::posix {
namespace {

using Main = int (*)(int, char**, char**);
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
  run_program(call_program, argc > 0 ? argv[0] : "program");
}

}  // namespace
}  // namespace waitpoint::posix

using namespace waitpoint::posix;

WAITPOINT_INTERPOSED int __libc_start_main(Main main, int argc, char** argv, void (*init)(), void (*fini)(),
                                           void (*rtld_fini)(), void* stack_end) {
  static constinit StartMain known = nullptr;
  call.main = main;
  return next(known, "__libc_start_main")(begin_with_main, argc, argv, init, fini, rtld_fini, stack_end);
}
