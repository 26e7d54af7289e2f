// SPDX-License-Identifier: BSD-3-Clause
// A mailbox: a bounded queue of letters to one task. A letter's arrival signals its owner's event.
//
//   client ---- request letter ---> control task of a module
//   client <--- replies ----------- (intermediate: the activity started; final: it ended, with report and output)
#pragma once

#include <atomic>
#include <deque>
#include <mutex>
#include <string>

#include "fibers/sync/threads.hpp"
#include "modules/genom/payload.hpp"
#include "modules/genom/report.hpp"

namespace waitpoint::genom {

class Mailbox;
class Module;

/// A withdrawal, of the request with its sender and number, is for a gate alone (request_gate.hpp).
enum class LetterKind : std::uint8_t { request, intermediate_reply, final_reply, withdrawal };

struct Letter {
  LetterKind kind = LetterKind::request;
  std::uint32_t request = 0;   ///< the number of the request type within its module
  std::uint32_t send_id = 0;   ///< the sender's own number for this request, repeated in its replies
  std::int32_t activity = -1;  ///< in replies: the activity's number, -1 if there is none
  Report report = ok;
  Mailbox* reply_to = nullptr;
  Module* module = nullptr;  ///< of a request in the mailbox of a gate: the module that it is for
  Payload payload;
};

class Mailbox {
 public:
  static constexpr std::size_t letters_max = 64;

  /// `owner` names the mailbox.
  explicit Mailbox(std::string owner);

  /// Puts a letter in and signals the owner; false if the mailbox is full.
  bool post(const Letter& letter);
  /// From now on replies to the owner's request `send_id` alone are accepted beyond the bound: the owner waits for
  /// them, and a lost reply would block it forever.
  void keep_room_for(std::uint32_t send_id) { awaited_ = send_id; }
  /// From now on all replies are accepted beyond the bound, for an owner that bounds its own requests and must not miss
  /// the end of any.
  void keep_room_for_replies() { keeps_replies_ = true; }
  /// Takes the oldest letter; false if there is none. Does not wait.
  bool take(Letter& letter);

  /// The owner's event: released once per letter, and by other sources of work for the owner.
  threads::counting_semaphore<>& event() { return event_; }
  const std::string& owner() const { return owner_; }

 private:
  std::string owner_;
  std::uint64_t name_;
  threads::mutex mutex_{"mailbox"};
  threads::counting_semaphore<> event_{0, "mailbox event"};
  std::deque<Letter> letters_;
  std::atomic<std::uint32_t> awaited_ = 0;  // send_id; 0: none
  std::atomic<bool> keeps_replies_ = false;
};

}  // namespace waitpoint::genom
