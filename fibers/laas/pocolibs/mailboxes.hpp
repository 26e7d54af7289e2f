// SPDX-License-Identifier: BSD-3-Clause
// A robot's mailboxes. One behaves as pocolibs' ring buffer of blocks does, of which only the sizes are kept:
//
//   a mailbox of n bytes    a ring of n + 12 - n % 4 bytes, never completely full
//   a message of n bytes    n + 12 - n % 4 of them: its length, the sender's id, the text, a mark of 1 to 4 bytes
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <vector>

#include "fibers/sync/blocking.hpp"
#include "fibers/sync/robot_state.hpp"

namespace waitpoint::laas {

struct Mailbox {
  struct Message {
    int from;
    std::vector<char> text;
  };

  /// Of a mailbox, or a message, of `bytes`.
  static constexpr int ring_bytes(int bytes) { return bytes + 12 - bytes % 4; }

  kernel::Object object{"mailbox"};
  std::string name;
  int device = 0;
  long owner = 0;                ///< the id of the task that made it
  int size = 0;                  ///< as its owner asked for it
  int used = 0;                  ///< bytes of the ring
  std::uint32_t generation = 0;  ///< counts its closings: a place is used again
  std::deque<Message> messages;

  bool has_room(int bytes) const { return ring_bytes(bytes) < ring_bytes(size) - used; }
  void push(int from, const char* text, int bytes);
  void pop();
  void clear();
};

class Mailboxes : public sync::RobotState {
 public:
  explicit Mailboxes(kernel::Robot&) {}
  static Mailboxes& here() { return sync::state_of<Mailboxes>(*sync::running_task().robot); }

  Mailbox& open(int device, const char* name, int size, long owner);
  /// Its waiting tasks return.
  void close(Mailbox& mailbox);
  /// Null if there is none.
  Mailbox* find(int device);
  /// The devices of a task's mailboxes, in the order of the table.
  std::vector<int> of_task(long owner) const;

  /// The device of each task that called mboxInit(), by its id.
  std::map<long, int> tasks;

 private:
  std::deque<Mailbox> all_;       // addresses stay valid
  std::vector<Mailbox*> closed_;  // for reuse
  std::map<int, Mailbox*> by_device_;
};

}  // namespace waitpoint::laas
