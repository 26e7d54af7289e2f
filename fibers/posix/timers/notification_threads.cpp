// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/timers/notification_threads.hpp"

#include <cstdlib>
#include <optional>

#include "core/error.hpp"
#include "fibers/posix/descriptors/descriptors.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/timer_firing.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/signals/signals.hpp"

namespace waitpoint::posix {

/// The list of all.
struct Notices {
  static Notice* first;

  static void remove(Notice& notice) {
    for (Notice** link = &first; *link != nullptr; link = &(*link)->next_)
      if (*link == &notice) {
        *link = notice.next_;
        return;
      }
  }

  static bool has(const void* address) {
    for (const Notice* each = first; each != nullptr; each = each->next_)
      if (each == address) return true;
    return false;
  }

  static Notice* next_due() {
    for (Notice* each = first; each != nullptr; each = each->next_)
      if (each->due_ > 0) return each;
    return nullptr;
  }

  static void* start_all(void*);
};

constinit Notice* Notices::first = nullptr;

namespace {

kernel::Object starter_object{"notification"};
bool has_starter = false;
int expected_from_outside = 0;

// A notification function and its argument.
struct Told {
  void (*function)(sigval);
  sigval value;
};

void* tell(void* argument) {
  const Told told = *static_cast<Told*>(argument);
  std::free(argument);
  told.function(told.value);
  return nullptr;
}

// Other threads run while it is made: they must not make another.
bool make_starter() {
  if (has_starter) return true;
  has_starter = true;
  kernel::running->scheduler->enter(starter_object);
  return has_starter = start_blocking_signals(Notices::start_all, nullptr, nullptr);
}

}  // namespace

bool start_blocking_signals(void* (*start)(void*), void* argument, const pthread_attr_t* attributes) {
  const SignalSet before = this_thread().blocked;
  this_thread().blocked = ~unblockable;
  pthread_t id = 0;
  const bool is_made = create(&id, attributes, {.posix = start}, false, argument) == 0;
  this_thread().blocked = before;
  return is_made;
}

void start_notification(const sigevent& event) {
  auto* const told = static_cast<Told*>(std::malloc(sizeof(Told)));
  if (told == nullptr) return;
  *told = {event.sigev_notify_function, event.sigev_value};
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  // Always detached: no thread can join it.
  if (event.sigev_notify_attributes != nullptr) attributes = *event.sigev_notify_attributes;
  pthread_attr_setdetachstate(&attributes, PTHREAD_CREATE_DETACHED);
  if (!start_blocking_signals(tell, told, &attributes)) std::free(told);
}

void* Notices::start_all(void*) {
  for (;;) {
    while (Notice* const notice = next_due()) {
      --notice->due_;
      start_notification(notice->event_);
    }
    std::optional<WaitsOutside> outside;
    if (expected_from_outside > 0) outside.emplace();
    block(starter_object, Time::max());
  }
  return nullptr;
}

Notice::Notice() = default;
Notice::~Notice() { Notices::remove(*this); }

bool Notice::prepare(const sigevent& event) {
  event_ = event;
  Notices::remove(*this);
  next_ = Notices::first;
  Notices::first = this;
  return make_starter();
}

void Notice::ring() {
  WAITPOINT_CHECK(Notices::has(this), "a notice rings that is not prepared");
  WAITPOINT_CHECK(starter_object.robot != nullptr, "a notice rings before the thread that starts others is made");
  ++due_;
  for (kernel::Task* task = starter_object.first_waiter; task != nullptr; task = task->next_waiter)
    thread_of(*task).woken_by_timer = is_timer_firing;
  starter_object.robot->scheduler->wake_all(starter_object);
}

void expect_ring_from_outside(int by) {
  expected_from_outside += by;
  WAITPOINT_CHECK(expected_from_outside >= 0, "more notices rang from outside than were expected");
  install_bell();
  kernel::running->scheduler->wake_all(starter_object);
}

bool ring_by_signal(const siginfo_t& information) {
  if (information.si_signo != bell || information.si_code != SI_MESGQ) return false;
  if (!Notices::has(information.si_value.sival_ptr)) return false;
  --expected_from_outside;
  static_cast<Notice*>(information.si_value.sival_ptr)->ring();
  return true;
}

void forget_notices() {
  Notices::first = nullptr;
  has_starter = false;
  expected_from_outside = 0;
}

}  // namespace waitpoint::posix
