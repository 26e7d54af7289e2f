// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/program/thread_area.hpp"

#include <unistd.h>

#include <cstddef>
#include <cstdint>

#include "core/error.hpp"
#include "fibers/switch/thread_pointer.hpp"

// Exported by the dynamic linker and the C library for thread libraries and debuggers.
extern "C" {
void* _dl_allocate_tls(void* block);
void _dl_deallocate_tls(void* area, bool free_block);
extern char _rtld_global[];
/// {bits, count, offset} of a member.
extern const std::uint32_t _thread_db_pthread_tid[3];
extern const std::uint32_t _thread_db_pthread_list[3];
extern const std::uint32_t _thread_db_rtld_global__dl_stack_user[3];
}

namespace waitpoint::posix {
namespace {

// The head of the thread control block, fixed by the ABI, and behind it a word that the C library leaves unused.
struct Head {
  void* pointer;
  void* vector;
  void* self;
  int multiple_threads;
  int global_flag;
  std::uintptr_t system_information;
  std::uintptr_t stack_guard;
  std::uintptr_t pointer_guard;
  Thread* thread;
};
static_assert(offsetof(Head, pointer) == 0 && offsetof(Head, self) == 0x10,
              "%fs:0 and %fs:0x10 are the thread pointer");
static_assert(offsetof(Head, stack_guard) == 0x28 && offsetof(Head, pointer_guard) == 0x30);
static_assert(offsetof(Head, thread) == 0x38 && sizeof(Head) == 0x40, "the unused word is the first behind the guards");

struct Link {
  Link* next;
  Link* previous;
};
static_assert(sizeof(Link) == 16, "the C library's list_t is two pointers");

template <class T>
T& field(void* base, const std::uint32_t (&description)[3]) {
  WAITPOINT_CHECK(description[0] == 8 * sizeof(T) && description[1] == 1, "a member of the C library has another size");
  WAITPOINT_CHECK(description[2] % alignof(T) == 0, "a member of the C library is not aligned");
  return *reinterpret_cast<T*>(static_cast<char*>(base) + description[2]);
}

Head& head_of(void* area) { return *static_cast<Head*>(area); }

Link& all_areas() { return field<Link>(_rtld_global, _thread_db_rtld_global__dl_stack_user); }

bool is_in_list(const Link& link) {
  const Link& all = all_areas();
  const Link* each = all.next;
  while (each != &all && each != &link) each = each->next;
  return each == &link;
}

pid_t maker = 0;  // the process that made the first area

}  // namespace

void* make_thread_area(int thread_id) {
  void* area = _dl_allocate_tls(nullptr);
  if (area == nullptr) return nullptr;
  if (maker == 0) maker = getpid();
  Head& head = head_of(area);
  const Head& own = head_of(own_thread_area());
  WAITPOINT_CHECK(head.thread == nullptr, "the C library uses the word of the control block that holds the thread");
  WAITPOINT_CHECK(own.self == &own, "the thread pointer does not point to a control block");
  head.pointer = head.self = area;
  head.stack_guard = own.stack_guard;
  head.pointer_guard = own.pointer_guard;
  field<int>(area, _thread_db_pthread_tid) = thread_id;
  // The dynamic linker walks this list when a library loaded later has thread-local variables.
  Link& all = all_areas();
  Link& link = field<Link>(area, _thread_db_pthread_list);
  WAITPOINT_CHECK(all.next->previous == &all, "the C library's list of threads is broken");
  link = {all.next, &all};
  all.next->previous = &link;
  all.next = &link;
  return area;
}

void free_thread_area(void* area) {
  const Link& link = field<Link>(area, _thread_db_pthread_list);
  // In a child of fork() the C library has emptied the list; in one of clone() it has not.
  if (getpid() == maker || is_in_list(link)) {
    WAITPOINT_CHECK(link.next->previous == &link && link.previous->next == &link,
                    "a thread's area is not in the C library's list");
    link.previous->next = link.next;
    link.next->previous = link.previous;
  }
  _dl_deallocate_tls(area, true);
}

void set_stack_guard(void* area, std::uint64_t word) {
  // The lowest byte is zero, as in the C library, so that overrunning strings end there.
  head_of(area).stack_guard = word & ~std::uintptr_t{0xFF};
}

Thread*& thread_of_area(void* area) { return head_of(area).thread; }

void* own_thread_area() { return kernel::thread_pointer(); }

}  // namespace waitpoint::posix
