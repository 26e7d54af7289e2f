// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/in_process/layer.hpp"

#include <dlfcn.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <new>

#include "core/error.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/base/preload.hpp"
#include "fibers/posix/files/file_records.hpp"
#include "fibers/posix/in_process/loaded_program.hpp"
#include "fibers/posix/ipc/named_objects.hpp"
#include "fibers/posix/links/robot_links.hpp"
#include "fibers/posix/links/stream_links.hpp"
#include "fibers/posix/program/allocator.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/signals/signals.hpp"
#include "fibers/posix/threads/deadlock.hpp"

namespace waitpoint::posix {

const bool has_host = true;

namespace {

// Holds default settings only: the scheduler is the host's.
alignas(Record) char own_record[sizeof(Record)];

void find_allocator() {
  void* const allocate = dlsym(RTLD_DEFAULT, "malloc");
  if (allocate == reinterpret_cast<void*>(of_c_library(&std::malloc, "malloc"))) return;
  dl_find_object library{};
  if (_dl_find_object(allocate, &library) != 0) return;
  allocator_code = {reinterpret_cast<std::uintptr_t>(library.dlfo_map_start),
                    reinterpret_cast<std::uintptr_t>(library.dlfo_map_end)};
}

[[gnu::constructor(101)]] void begin() {
  record = new (own_record) Record();
  find_allocator();
  leave_preload();
}

bool start_program(LoadedProgram& program, kernel::Scheduler& scheduler, kernel::Robot& robot) {
  WAITPOINT_CHECK(kernel::running == nullptr, "a program starts from within a task");
  program.robot = &robot;
  forget_files();
  kernel::hooks(scheduler).continues_after_cycle = continues_after_cycle;
  return start(program, scheduler);
}

bool has_ended(const LoadedProgram& program, int& status) {
  status = program.status;
  return program.ended;
}

// Without a carrier, data in transit is lost.
void carry_by(const Carrier* carrier) {
  if (carrier == nullptr) forget_streams();
  set_carrier(carrier);
}

}  // namespace

void refuse(const char* reason) {
  std::fprintf(stderr, "waitpoint: %s\n", reason);
  WAITPOINT_NEXT(_exit)(1);
  __builtin_unreachable();
}

}  // namespace waitpoint::posix

using namespace waitpoint::posix;

extern "C" [[gnu::visibility("default")]] constinit const InProcessLayer waitpoint_in_process{
    load, start_program, has_ended, drop, forget_named_objects, is_thread, deliver_signals, carry_by,
};
