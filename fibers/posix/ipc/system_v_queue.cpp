// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/ipc/system_v_queue.hpp"

#include <climits>
#include <cstring>

#include "core/error.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/posix/base/chain.hpp"
#include "fibers/posix/descriptors/descriptors.hpp"
#include "fibers/posix/family/order.hpp"
#include "fibers/posix/ipc/system_v_ends.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/signals/cancellation.hpp"
#include "fibers/posix/signals/signals.hpp"

namespace waitpoint::posix::system_v {
namespace {

kernel::Object& object_of_room(const Queue& queue) { return waitable_at<KnownRoom>(&queue.room).object; }

bool is_wanted(const Wanted& wanted, long type) {
  if (wanted.type == 0) return true;
  if (wanted.type < 0) return type <= (wanted.type == LONG_MIN ? LONG_MAX : -wanted.type);
  return (type == wanted.type) != ((wanted.flags & MSG_EXCEPT) != 0);
}

// The link to the message to be received next; a null link if there is none.
Message** find_message(Queue& queue, const Wanted& wanted) {
  if ((wanted.flags & MSG_COPY) != 0) {
    Message** link = &queue.first;
    for (long number = wanted.type; *link != nullptr && number > 0; --number) link = &(*link)->next;
    return link;
  }
  Message** found = nullptr;
  Message** link = &queue.first;
  for (; *link != nullptr; link = &(*link)->next) {
    if (!is_wanted(wanted, (*link)->type)) continue;
    if (wanted.type >= 0) return link;
    if (found == nullptr || (*link)->type < (*found)->type) found = link;
  }
  return found != nullptr ? found : link;
}

void append(Queue& queue, Message& message) {
  // In this order a process that is killed in between leaves too great a count.
  queue.bytes += message.size;
  ++queue.count;
  posix::append(queue.first, message);
}

void end_receiving(Queue& queue, Receiving& receiving, Message* message, int error) {
  WAITPOINT_CHECK(receiving.error < 0, "a receiver ends twice");
  WAITPOINT_CHECK((error == 0) == (message != nullptr), "a receiver ends with a message and an error, or without both");
  posix::remove(queue.first_receiving, receiving);
  receiving.message = message;
  __atomic_store_n(&receiving.error, error, __ATOMIC_SEQ_CST);
  if (receiving.process != family::this_process()) return family::ring(family::of_objects);
  // A signal or a cancellation may have woken it before: then it finds the result when it runs.
  if (receiving.task->state == kernel::TaskState::blocked) kernel::wake(*receiving.task->scheduler, *receiving.task);
}

// Drops the waiting calls of killed processes.
void drop_dead(Queue& queue) {
  take_out_dead(
      queue.first_receiving, [](const Receiving& each) { return each.process; },
      [](Receiving& each) { family::give(&each); });
}

// Hands the message to a receiver that waits for such a one, by the chooser's choice. Receivers with too small a buffer
// end with an error.
bool give(Queue& queue, Message& message) {
  drop_dead(queue);
  for (;;) {
    std::uint32_t count = 0;
    for (const Receiving* each = queue.first_receiving; each != nullptr; each = each->next)
      if (is_wanted(each->wanted, message.type)) ++count;
    if (count == 0) return false;
    std::uint32_t chosen =
        is_simulated() ? kernel::chooser(*kernel::running->scheduler).waiter(*kernel::running, count) : 0;
    WAITPOINT_CHECK(chosen < count, "a receiver is chosen that does not wait for such a message");
    Receiving* each = queue.first_receiving;
    while (!is_wanted(each->wanted, message.type) || chosen-- > 0) each = each->next;
    if (message.size > each->wanted.size && (each->wanted.flags & MSG_NOERROR) == 0) {
      end_receiving(queue, *each, nullptr, E2BIG);
      continue;
    }
    queue.last_receiver = each->process;
    queue.received = date();
    end_receiving(queue, *each, &message, 0);
    return true;
  }
}

bool has_room(const Queue& queue, std::size_t size) {
  return queue.bytes + size <= queue.bytes_max && queue.count + 1 <= queue.bytes_max;
}

}  // namespace

void wake_senders(const Queue& queue) {
  if (is_simulated()) kernel::wake_all(*kernel::running->scheduler, object_of_room(queue));
  family::ring(family::of_objects);
}

void end_all(Queue& queue, int error) {
  while (queue.first_receiving != nullptr) end_receiving(queue, *queue.first_receiving, nullptr, error);
  wake_senders(queue);
}

namespace {

// The condition that a sender waits for.
struct Sending {
  const Queue& queue;
  std::size_t size;
};
bool may_send(const void* what) {
  const auto& sending = *static_cast<const Sending*>(what);
  return sending.queue.removed || has_room(sending.queue, sending.size);
}

// Returns an error number.
int put(Queue& queue, long type, const char* bytes, std::size_t size) {
  WAITPOINT_CHECK(type > 0 && size <= bytes_a_message_max, "a message is sent that msgsnd() refuses");
  auto* const message = static_cast<Message*>(family::take(sizeof(Message) + size));
  if (message == nullptr) return ENOMEM;
  message->type = type;
  message->size = size;
  std::memcpy(message->bytes(), bytes, size);
  queue.last_sender = family::this_process();
  queue.sent = date();
  if (!give(queue, *message)) append(queue, *message);
  return 0;
}

}  // namespace

int send_message(Queue& queue, long type, const char* bytes, std::size_t size, int flags) {
  const CancellationPoint point;
  pass_if_simulated(kernel::Operation::send, &object_of(queue));
  const Sending sending{queue, size};
  for (;;) {
    {
      if (queue.removed) return fail(EIDRM);
      if (has_room(queue, size)) {
        const int error = put(queue, type, bytes, size);
        return error == 0 ? 0 : fail(error);
      }
    }
    if ((flags & IPC_NOWAIT) != 0) return fail(EAGAIN);
    if (!is_simulated()) refuse("a thread waits before main() begins");
    kernel::enter(object_of_room(queue));
    Wait ended = Wait::interrupted;
    if (!point.was_cancelled()) ended = wait_on_shared(object_of_room(queue), Time::max(), may_send, &sending);
    if (point.was_cancelled()) return fail(ECANCELED);
    if (ended == Wait::interrupted && is_interrupted(Restart::never)) return fail(EINTR);
  }
}

namespace {

// Takes a message out of the queue.
void take_out(Queue& queue, Message** link) {
  Message* const message = *link;
  WAITPOINT_CHECK(queue.count > 0 && queue.bytes >= message->size, "a message queue has more than it counts");
  *link = message->next;
  queue.bytes -= message->size;
  --queue.count;
  queue.last_receiver = family::this_process();
  queue.received = date();
  wake_senders(queue);
}

// Writes the message to the program, and frees it unless it stays in the queue.
ssize_t hand_over(Message& message, const Wanted& wanted, void* to) {
  const std::size_t taken = message.size < wanted.size ? message.size : wanted.size;
  std::memcpy(to, &message.type, sizeof message.type);
  std::memcpy(static_cast<char*>(to) + sizeof message.type, message.bytes(), taken);
  if ((wanted.flags & MSG_COPY) == 0) family::give(&message);
  return static_cast<ssize_t>(taken);
}

bool is_wait_over(const void* receiving) {
  return __atomic_load_n(&static_cast<const Receiving*>(receiving)->error, __ATOMIC_SEQ_CST) >= 0;
}

// Waits until a message is handed over. Returns an error number.
int wait_for_message(Queue& queue, Receiving& receiving, const CancellationPoint& point) {
  while (!is_wait_over(&receiving)) {
    Wait ended = Wait::interrupted;
    if (!point.was_cancelled()) ended = wait_on_shared(object_of(queue), Time::max(), is_wait_over, &receiving);
    if (is_wait_over(&receiving)) break;
    if (ended != Wait::interrupted) continue;  // check again
    posix::remove(queue.first_receiving, receiving);
    if (point.was_cancelled()) return ECANCELED;
    if (is_interrupted(Restart::never)) return EINTR;
    if (queue.removed) return EIDRM;
    posix::append(queue.first_receiving, receiving);
  }
  return receiving.error;
}

}  // namespace

ssize_t take_message(Queue& queue, const Wanted& wanted, void* to) {
  const CancellationPoint point;
  pass_if_simulated(kernel::Operation::receive, &object_of(queue));
  Receiving* receiving = nullptr;
  if (queue.removed) return fail(EIDRM);
  if (Message** const link = find_message(queue, wanted); *link != nullptr) {
    Message& message = **link;
    if (message.size > wanted.size && (wanted.flags & MSG_NOERROR) == 0) return fail(E2BIG);
    if ((wanted.flags & MSG_COPY) == 0) take_out(queue, link);
    return hand_over(message, wanted, to);
  }
  if ((wanted.flags & IPC_NOWAIT) != 0) return fail(ENOMSG);
  if (!is_simulated()) refuse("a thread waits before main() begins");
  receiving = static_cast<Receiving*>(family::take(sizeof(Receiving)));
  if (receiving == nullptr) return fail(ENOMEM);
  *receiving = {family::this_process(), kernel::running, wanted, nullptr, -1, nullptr};
  posix::append(queue.first_receiving, *receiving);
  int error = 0;
  Message* message = nullptr;
  {
    const Listed listed(queue.first_receiving, *receiving);
    error = wait_for_message(queue, *receiving, point);
    message = receiving->message;
  }
  ssize_t taken = -1;
  WAITPOINT_CHECK(error != 0 || message != nullptr, "a receiver ends without a message and without an error");
  if (error == 0) taken = hand_over(*message, wanted, to);
  // A signal may have come together with the message.
  if (error == 0 && deliverable(this_thread()) != 0) handle_signals();
  return error == 0 ? taken : fail(error);
}

void forget_message_waiter(const kernel::Task& task) {
  for (int slot = 0; slot < queues().end(); ++slot) {
    Queue* const queue = queues().in_slot(slot);
    if (queue == nullptr) continue;
    Receiving* const waiter = take_first(queue->first_receiving, [&](const Receiving& each) {
      return each.task == &task && each.process == family::this_process();
    });
    if (waiter == nullptr) continue;
    family::give(waiter);
    --queue->users;
    return;
  }
}

void forget_messages() { queues().clear(); }

}  // namespace waitpoint::posix::system_v
