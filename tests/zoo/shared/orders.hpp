// SPDX-License-Identifier: BSD-3-Clause
// Events assumed to occur in one order: the specimens with the same text on simulated threads (tests/zoo) and on system
// threads (tests/exec/zoo).
//
// The includer declares the primitives before, in this namespace: Crew, check, this_thread, mutex.
#pragma once

#include <mutex>

namespace waitpoint::zoo {
namespace {

// The subscriber comes after the first messages, which are not kept for it.
template <bool mended>
void late_subscriber() {
  constexpr int messages = 15;
  mutex topic;
  int received = 0, kept = 0;
  bool subscribed = false;
  Crew crew;
  crew.add("subscriber", [&] {
    const std::lock_guard guard(topic);
    subscribed = true;
    if (mended) received += kept;
  });
  crew.add("publisher", [&] {
    for (int i = 0; i < messages; ++i) {
      const std::lock_guard guard(topic);
      (subscribed ? received : kept) += 1;
    }
  });
  crew.join();
  check(received > 0, "no message at all is received");
}

// A follower that starts in the middle of the route takes the second half for all of it. All, nearly all or nothing
// would be noticed.
template <bool mended, int points>
void half_the_route() {
  mutex route;
  int sent = 0, heard = 0;
  bool follows = false;
  Crew crew;
  crew.add("follower", [&] {
    const std::lock_guard guard(route);
    follows = true;
    if (mended) heard = sent;
  });
  crew.add("planner", [&] {
    for (int i = 0; i < points; ++i) {
      const std::lock_guard guard(route);
      ++sent;
      if (follows) ++heard;
    }
  });
  crew.join();
  check(heard != points / 2, "half the route ends in the river");
}

}  // namespace
}  // namespace waitpoint::zoo
