// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/descriptors/epoll_watches.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "fibers/posix/descriptors/owners.hpp"

namespace waitpoint::posix {
namespace {

EpollWatch* watches = nullptr;
std::size_t watch_count = 0, watch_room = 0;

/// Of an epoll descriptor whose watches are all in the list.
enum class Watching : std::uint8_t { nothing, listed, unknown };
Watching watching[known_descriptors_max];

}  // namespace

bool watches_others(int descriptor) {
  return descriptor >= 0 && descriptor < known_descriptors_max && watching[descriptor] != Watching::nothing;
}

void note_watch(int epoll, int descriptor, const epoll_event& what) {
  if (epoll < 0 || epoll >= known_descriptors_max) return;
  if (watching[epoll] == Watching::nothing) watching[epoll] = Watching::listed;
  for (std::size_t i = 0; i < watch_count; ++i)
    if (watches[i].epoll == epoll && watches[i].descriptor == descriptor) return void(watches[i].what = what);
  if (watch_count == watch_room) {
    const std::size_t room = 2 * watch_room + 32;
    auto* const more = static_cast<EpollWatch*>(std::realloc(watches, room * sizeof(EpollWatch)));
    if (more == nullptr) return void(watching[epoll] = Watching::unknown);
    watches = more;
    watch_room = room;
  }
  watches[watch_count++] = {epoll, descriptor, what};
}

void end_watch(int epoll, int descriptor) {
  for (std::size_t i = 0; i < watch_count; ++i)
    if (watches[i].epoll == epoll && watches[i].descriptor == descriptor)
      return void(watches[i] = watches[--watch_count]);
}

void note_shared_epoll(int from, int made) {
  if (!watches_others(from) || made < 0 || made >= known_descriptors_max) return;
  watching[from] = watching[made] = Watching::unknown;
}

void note_shared_epolls() {
  for (std::size_t i = 0; i < watch_count; ++i) watching[watches[i].epoll] = Watching::unknown;
}

void forget_watches_of(int epoll) {
  if (!watches_others(epoll)) return;
  watching[epoll] = Watching::nothing;
  watch_count = static_cast<std::size_t>(
      std::remove_if(watches, watches + watch_count, [=](const EpollWatch& watch) { return watch.epoll == epoll; }) -
      watches);
}

bool are_watches_known(int epoll) { return watching[epoll] == Watching::listed; }

const EpollWatch* next_watch(int epoll, const EpollWatch* after) {
  for (const EpollWatch* next = after == nullptr ? watches : after + 1; next != watches + watch_count; ++next)
    if (next->epoll == epoll) return next;
  return nullptr;
}

void put_in_order(int epoll, epoll_event* events, int count) {
  if (count < 2 || !watches_others(epoll) || !are_watches_known(epoll)) return;
  int in_order = 0;
  for (const EpollWatch* watch = next_watch(epoll, nullptr); watch != nullptr; watch = next_watch(epoll, watch)) {
    for (int k = in_order; k < count; ++k) {
      if (events[k].data.u64 != watch->what.data.u64) continue;
      std::rotate(events + in_order, events + k, events + k + 1);
      ++in_order;
      break;
    }
  }
}

}  // namespace waitpoint::posix
