// SPDX-License-Identifier: BSD-3-Clause
// A System V message queue. A message is handed directly to a waiting receiver, of any process; senders that wait for
// room are woken and check again.
#pragma once

#include <sys/msg.h>

#include "fibers/posix/ipc/system_v.hpp"

namespace waitpoint::posix::system_v {

// Linux's defaults.
inline constexpr int queues_max = 32000;
inline constexpr std::size_t bytes_a_message_max = 8192, bytes_a_queue_max = 16384;

struct Message {
  long type;
  std::size_t size;
  Message* next;
  char* bytes() { return reinterpret_cast<char*>(this + 1); }
};

/// The arguments of a receiving call.
struct Wanted {
  long type;
  std::size_t size;
  int flags;
};

/// A call that waits to receive, of any process of the family.
struct Receiving {
  pid_t process;
  kernel::Task* task;  // valid in its own process only
  Wanted wanted;
  Message* message;  // handed to it
  int error;         // its result; -1 while it waits
  Receiving* next;
};

/// Senders wait for it; each process has a waitable for its address.
struct Room {};
struct KnownRoom : Waitable {
  static constexpr Kind kind_of_all = Kind::system_v;
  explicit KnownRoom(const void* address) : Waitable(kind_of_all, "room in a System V message queue", address) {}
};

struct Queue : Common {
  Queue() : Common("System V message queue") {}
  ~Queue() {
    while (Message* message = first) {
      first = message->next;
      family::give(message);
    }
  }

  Room room;
  std::size_t bytes = 0, bytes_max = bytes_a_queue_max;
  unsigned long count = 0;
  time_t sent = 0, received = 0, changed = 0;
  pid_t last_sender = 0, last_receiver = 0;
  Message* first = nullptr;
  Receiving* first_receiving = nullptr;
};

using Queues = Table<Queue, queues_max>;
inline Queues& queues() { return table_of<Queues>(family::Part::messages); }

/// As msgsnd(), but ECANCELED if the thread was cancelled.
int send_message(Queue& queue, long type, const char* bytes, std::size_t size, int flags);
/// As msgrcv(), but ECANCELED if the thread was cancelled.
ssize_t take_message(Queue& queue, const Wanted& wanted, void* to);

/// Wakes the senders that wait for room.
void wake_senders(const Queue& queue);
/// Ends all waiting calls, receivers with this error.
void end_all(Queue& queue, int error);

}  // namespace waitpoint::posix::system_v
