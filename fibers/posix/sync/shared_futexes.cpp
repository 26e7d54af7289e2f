// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/sync/shared_futexes.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "fibers/posix/family/order.hpp"

namespace waitpoint::posix {
namespace {

constexpr int futexes_max = 1024;

struct Futexes {
  SharedFutex all[futexes_max];
};

// Null if there is none.
SharedFutex* find(Futexes& futexes, const void* address) {
  SharedFutex* const end = futexes.all + futexes_max;
  SharedFutex* const found = std::find_if(futexes.all, end, [&](const SharedFutex& each) {
    return each.address == address && each.waiters + each.woken > 0;
  });
  return found != end ? found : nullptr;
}

}  // namespace

SharedFutex* begin_to_wait(const void* address) {
  auto* const futexes = static_cast<Futexes*>(family::common(family::Part::futexes, sizeof(Futexes)));
  if (futexes == nullptr) return nullptr;
  SharedFutex* futex = find(*futexes, address);
  if (futex == nullptr) {
    SharedFutex* const end = futexes->all + futexes_max;
    futex = std::find_if(futexes->all, end, [](const SharedFutex& each) { return each.waiters + each.woken == 0; });
    if (futex == end) return nullptr;
    futex->address = address;
  }
  ++futex->waiters;
  return futex;
}

bool end_waiting(SharedFutex& futex, bool by_own) {
  WAITPOINT_CHECK(futex.waiters + futex.woken > 0, "a thread ends a wait at a futex that counts none");
  // Both may have woken the last waiter: then the wake-up by the other process has no one else to go to.
  const bool by_other = futex.woken > 0 && (!by_own || futex.waiters == 0);
  --(by_other ? futex.woken : futex.waiters);
  return by_own || by_other;
}

bool has_woken(const void* kept) {
  return __atomic_load_n(&(*static_cast<SharedFutex* const*>(kept))->woken, __ATOMIC_SEQ_CST) > 0;
}

std::uint32_t wake_others(const void* address, std::uint32_t most, std::uint32_t own) {
  std::uint32_t woken = 0;
  auto* const futexes = static_cast<Futexes*>(family::common(family::Part::futexes, 0));
  SharedFutex* const futex = futexes != nullptr ? find(*futexes, address) : nullptr;
  if (futex == nullptr || futex->waiters <= own) return 0;
  woken = std::min(most, futex->waiters - own);
  // In this order a process that is killed in between leaves too many, never too few.
  futex->woken += woken;
  futex->waiters -= woken;
  if (woken > 0) family::ring(family::of_objects);
  return woken;
}

}  // namespace waitpoint::posix
