// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/reruns/page_map.hpp"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/syscall.h>

#include "fibers/posix/base/direct_call.hpp"

namespace waitpoint::posix {
namespace {

// Of Linux 6.7, as <linux/fs.h> has it.
enum Category : std::uint64_t { present = 1 << 3, swapped = 1 << 4, of_zeros = 1 << 5 };
struct Scan {
  std::uint64_t size, flags, begin, end, reached, found, found_max, pages_max;
  std::uint64_t inverted, all_of, any_of, returned;
};
constexpr unsigned long scan_request = _IOWR('f', 16, Scan);

}  // namespace

PageMap::PageMap()
    : descriptor_(static_cast<int>(
          call_directly(SYS_openat, AT_FDCWD, reinterpret_cast<long>("/proc/self/pagemap"), O_RDONLY | O_CLOEXEC))) {}

PageMap::~PageMap() {
  if (descriptor_ >= 0) call_directly(SYS_close, descriptor_);
}

bool PageMap::read(std::uintptr_t from, Entry* entries, std::size_t count) const {
  const auto bytes = static_cast<long>(count * sizeof *entries);
  return call_directly(SYS_pread64, descriptor_, reinterpret_cast<long>(entries), bytes,
                       static_cast<long>(from / page_bytes * sizeof *entries)) == bytes;
}

bool PageMap::Found::is_in_memory() const { return (categories & swapped) == 0; }

long PageMap::scan(const Pages& pages, Found (&found)[found_max]) const {
  Scan scan{.size = sizeof scan,
            .flags = 0,
            .begin = pages.begin,
            .end = pages.end,
            .reached = 0,
            .found = reinterpret_cast<std::uint64_t>(found),
            .found_max = found_max,
            .pages_max = 1024,
            .inverted = of_zeros,
            .all_of = of_zeros,
            .any_of = present | swapped,
            .returned = swapped};
  const long count =
      call_directly(SYS_ioctl, descriptor_, static_cast<long>(scan_request), reinterpret_cast<long>(&scan));
  return scan.reached == pages.end ? count : -1;
}

void PageMap::discard(const Pages& pages) {
  call_directly(SYS_madvise, static_cast<long>(pages.begin), static_cast<long>(pages.end - pages.begin), MADV_DONTNEED);
}

long page_faults() {
  rusage used{};
  call_directly(SYS_getrusage, RUSAGE_SELF, reinterpret_cast<long>(&used));
  return used.ru_minflt + used.ru_majflt;
}

}  // namespace waitpoint::posix
