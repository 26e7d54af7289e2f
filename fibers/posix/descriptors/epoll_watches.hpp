// SPDX-License-Identifier: BSD-3-Clause
// What each epoll descriptor watches, and in which order it was asked to: the events that it returns are put in that
// order, and its readers need check only when something that it watches may have changed (connections.hpp).
#pragma once

#include <sys/epoll.h>

namespace waitpoint::posix {

/// An epoll descriptor and one that it watches. The system keeps a watch when the descriptor is closed that has a
/// duplicate: so does the list.
struct EpollWatch {
  int epoll;
  int descriptor;
  epoll_event what;
};

/// The epoll descriptor watches another for these events, or no longer.
void note_watch(int epoll, int descriptor, const epoll_event& what);
void end_watch(int epoll, int descriptor);
/// Others may change by another descriptor what it watches: a duplicate of it, or a process after a fork.
void note_shared_epoll(int from, int made);
void note_shared_epolls();
/// The descriptor is closed.
void forget_watches_of(int epoll);

/// True for an epoll descriptor that was asked to watch something.
bool watches_others(int descriptor);
/// False of an epoll descriptor whose watches others may change, too.
bool are_watches_known(int epoll);
/// The epoll descriptor's first watch, or the one after another of them; null after the last.
const EpollWatch* next_watch(int epoll, const EpollWatch* after);
/// Puts events that the epoll descriptor returned in the order of the watches. The system returns them in the order in
/// which it noted them, which on a loaded machine depends on real time.
void put_in_order(int epoll, epoll_event* events, int count);

}  // namespace waitpoint::posix
