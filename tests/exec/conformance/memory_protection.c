// SPDX-License-Identifier: BSD-3-Clause
// mprotect(), mmap().
#include "tests/exec/conformance/signals.h"

#include <errno.h>
#include <sys/mman.h>
#include <unistd.h>

static char* a_page(void) {
  return mmap(NULL, (size_t)sysconf(_SC_PAGESIZE), PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
}

static volatile sig_atomic_t faults;
static char* page;
static void allow(int signal) {
  (void)signal;
  ++faults;
  mprotect(page, (size_t)sysconf(_SC_PAGESIZE), PROT_READ | PROT_WRITE);
}
CASE(a_write_to_a_protected_page_is_a_fault_until_it_is_allowed) {
  page = a_page();
  page[3] = 1;
  act(SIGSEGV, allow, 0);
  EXPECT_IS(mprotect(page, (size_t)sysconf(_SC_PAGESIZE), PROT_READ), 0);
  EXPECT_IS(page[3], 1);
  ((volatile char*)page)[3] = 2;
  EXPECT_IS(faults, 1);
  EXPECT_IS(page[3], 2);
}
CASE(an_address_within_a_page_cannot_be_protected) { EXPECT_FAILS(mprotect(a_page() + 1, 1, PROT_READ), EINVAL); }
CASE(memory_of_no_size_cannot_be_mapped) {
  EXPECT_FAILS(mmap(NULL, 0, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) == MAP_FAILED ? -1 : 0, EINVAL);
  EXPECT_FAILS(mmap64(NULL, 0, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) == MAP_FAILED ? -1 : 0, EINVAL);
}
CASE(what_is_not_mapped_cannot_be_protected) {
  char* const gone = a_page();
  munmap(gone, (size_t)sysconf(_SC_PAGESIZE));
  EXPECT_FAILS(mprotect(gone, 1, PROT_READ), ENOMEM);
}
