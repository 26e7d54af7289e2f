// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/timers/notification_threads.hpp"

#include <cstdlib>
#include <new>
#include <optional>

#include "core/error.hpp"
#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/posix/descriptors/descriptors.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/timer_firing.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/signals/signals.hpp"
#include "fibers/posix/timers/program_timers.hpp"

namespace waitpoint::posix {

/// The layer's thread of a program, which starts its notification threads.
struct NotificationStarter {
  kernel::Object object{"notification"};
  bool is_made = false;
  int expected_from_outside = 0;
};

/// The list of all, of all programs.
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

  static Notice* next_due(const Program& program) {
    for (Notice* each = first; each != nullptr; each = each->next_)
      if (each->program_ == &program && each->due_ > 0) return each;
    return nullptr;
  }

  static void remove_all_of(const Program& program) {
    for (Notice** link = &first; *link != nullptr;)
      if ((*link)->program_ == &program)
        *link = (*link)->next_;
      else
        link = &(*link)->next_;
  }

  static NotificationStarter& starter_of(const Notice& notice) { return *notice.program_->notification_starter; }

  static void* start_all(void*);
};

constinit Notice* Notices::first = nullptr;

namespace {

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

// False without memory. Other threads run while it is made: they must not make another.
bool make_starter(Program& program) {
  if (program.notification_starter == nullptr) {
    void* const memory = std::malloc(sizeof(NotificationStarter));
    if (memory == nullptr) return false;
    program.notification_starter = new (memory) NotificationStarter();
  }
  NotificationStarter& starter = *program.notification_starter;
  if (starter.is_made) return true;
  starter.is_made = true;
  kernel::enter(starter.object);
  return starter.is_made = start_blocking_signals(Notices::start_all, nullptr, nullptr);
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
  Program& program = this_program();
  NotificationStarter& starter = *program.notification_starter;
  for (;;) {
    while (Notice* const notice = next_due(program)) {
      --notice->due_;
      start_notification(notice->event_);
    }
    std::optional<WaitsOutside> outside;
    if (starter.expected_from_outside > 0) outside.emplace();
    block(starter.object, Time::max());
  }
  return nullptr;
}

Notice::Notice() = default;
Notice::~Notice() { Notices::remove(*this); }

bool Notice::prepare(const sigevent& event) {
  event_ = event;
  program_ = &this_program();
  Notices::remove(*this);
  next_ = Notices::first;
  Notices::first = this;
  return make_starter(*program_);
}

void Notice::ring() {
  WAITPOINT_CHECK(Notices::has(this), "a notice rings that is not prepared");
  kernel::Object& starter = Notices::starter_of(*this).object;
  WAITPOINT_CHECK(starter.robot != nullptr, "a notice rings before the thread that starts others is made");
  ++due_;
  for (kernel::Task* task = starter.first_waiter; task != nullptr; task = task->next_waiter)
    thread_of(*task).woken_by_timer = is_timer_firing;
  kernel::wake_all(*starter.robot->scheduler, starter);
}

void expect_ring_from_outside(int by) {
  NotificationStarter& starter = *this_program().notification_starter;
  starter.expected_from_outside += by;
  WAITPOINT_CHECK(starter.expected_from_outside >= 0, "more notices rang from outside than were expected");
  install_bell();
  kernel::wake_all(*kernel::running->scheduler, starter.object);
}

bool ring_by_signal(const siginfo_t& information) {
  if (information.si_signo != bell || information.si_code != SI_MESGQ) return false;
  if (!Notices::has(information.si_value.sival_ptr)) return false;
  auto& notice = *static_cast<Notice*>(information.si_value.sival_ptr);
  --Notices::starter_of(notice).expected_from_outside;
  notice.ring();
  return true;
}

void forget_notices(Program& program) {
  Notices::remove_all_of(program);
  std::free(program.notification_starter);
  program.notification_starter = nullptr;
}

}  // namespace waitpoint::posix
