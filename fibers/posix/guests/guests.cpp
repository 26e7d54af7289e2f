// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/guests/guests.hpp"

#include <dlfcn.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>

#include "core/error.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/base/preload.hpp"
#include "fibers/posix/files/file_records.hpp"
#include "fibers/posix/ipc/named_objects.hpp"
#include "fibers/posix/links/robot_links.hpp"
#include "fibers/posix/links/stream_links.hpp"
#include "fibers/posix/members/members.hpp"
#include "fibers/posix/program/allocator.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/signals/signals.hpp"
#include "fibers/posix/threads/deadlock.hpp"

namespace waitpoint::posix {

struct Guest {
  char label[kernel::name_size] = {};
  Member member;
  char* words[];  ///< the arguments, and null
};

const bool has_host = true;

namespace {

// Holds default settings only: the scheduler is the host's.
alignas(Record) char own_record[sizeof(Record)];
static_assert(sizeof(Guest) % alignof(char*) == 0, "a guest's words are behind it");

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

Guest* load_guest(const char* name, int argc, const char* const* argv, Guests::Error& error) {
  WAITPOINT_CHECK(argc > 0 && argv != nullptr && argv[0] != nullptr, "a guest has no file");
  auto* const memory = std::calloc(1, sizeof(Guest) + (static_cast<std::size_t>(argc) + 1) * sizeof(char*));
  if (memory == nullptr) {
    std::snprintf(error, sizeof error, "there is no memory for it");
    return nullptr;
  }
  Guest& guest = *new (memory) Guest();
  std::snprintf(guest.label, sizeof guest.label, "%s: ", name);
  for (int i = 0; i < argc; ++i) guest.words[i] = strdup(argv[i]);
  Member& member = guest.member;
  member.label = guest.label;
  member.is_service = true;
  member.argc = argc;
  member.argv = guest.words;
  if (load(member.image, argv[0], error)) return &guest;
  for (int i = 0; i < argc; ++i) std::free(guest.words[i]);
  std::free(&guest);
  return nullptr;
}

bool start_guest(Guest& guest, kernel::Scheduler& scheduler, kernel::Robot& robot) {
  WAITPOINT_CHECK(kernel::running == nullptr, "a guest starts from within a task");
  guest.member.robot = &robot;
  forget_files();
  scheduler.hooks().continues_after_cycle = continues_after_cycle;
  return start(guest.member, scheduler);
}

bool guest_has_ended(const Guest& guest, int& status) {
  status = guest.member.status;
  return guest.member.ended;
}

void take_away(Guest* guest, kernel::Scheduler& scheduler) {
  drop(guest->member, scheduler);
  for (int i = 0; i < guest->member.argc; ++i) std::free(guest->words[i]);
  std::free(guest);
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

extern "C" [[gnu::visibility("default")]] constinit const Guests waitpoint_guests{
    load_guest, start_guest, guest_has_ended, take_away, forget_named_objects, is_thread, deliver_signals, carry_by,
};
