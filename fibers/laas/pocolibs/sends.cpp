// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/laas/pocolibs/sends.hpp"
#include "fibers/laas/pocolibs/letters.hpp"
#include "fibers/laas/tasks.hpp"
#include "fibers/laas/ticks.hpp"

namespace waitpoint::laas {
namespace {

struct Correspondences : sync::RobotState {
  explicit Correspondences(kernel::Robot&) {}
  std::map<long, Correspondence> by_task;
};

// The letter that the first reply is for; null if none waits for it.
LETTER_ID letter_for(const LETTER_HDR& head, Send& send) {
  if (head.type == INTERMED_REPLY) return send.state == WAITING_INTERMED_REPLY ? send.intermediate : nullptr;
  return head.type == FINAL_REPLY && send.waits() ? send.final : nullptr;
}

// Takes the first reply; false if no letter waits for it, or it does not fit.
bool take_reply(Correspondence& own) {
  LETTER_HDR head;
  MBOX_ID from = 0;
  int bytes = 0;
  constexpr int head_size = sizeof head;
  if (mboxSpy(own.replies, &from, &bytes, reinterpret_cast<char*>(&head), head_size) != head_size) return false;
  Send* const send = own.find(head.sendId);
  const LETTER_ID letter = send != nullptr ? letter_for(head, *send) : nullptr;
  if (letter == nullptr || !is_letter(letter)) return false;
  if (mboxRcv(own.replies, &from, reinterpret_cast<char*>(letter->pHdr), letter->size, 1) <= 0) return false;
  send->state = head.type == INTERMED_REPLY ? WAITING_FINAL_REPLY : FINAL_REPLY_OK;
  return true;
}

}  // namespace

int Send::ticks_left() const {
  const int timeout = state == WAITING_INTERMED_REPLY ? intermediate_timeout : final_timeout;
  if (timeout == 0) return 0;
  WAITPOINT_REQUIRE(Ticks::here().running(), "a reply's time-out in ticks, but h2initGlob() started no clock");
  const auto passed = static_cast<int>(Ticks::here().now() - sent);
  return timeout > passed ? timeout - passed : -1;
}

int Send::check() {
  if (waits() && ticks_left() < 0)
    state = state == WAITING_INTERMED_REPLY ? INTERMED_REPLY_TIMEOUT : FINAL_REPLY_TIMEOUT;
  return state;
}

Send* Correspondence::find(int send_id) {
  if (send_id >= 0 && send_id < MAX_SEND) return &sends[static_cast<std::size_t>(send_id)];
  fail(S_gcomLib_ERR_SEND_ID);
  return nullptr;
}

void Correspondence::take_replies() {
  int bytes = 0;
  while (mboxIoctl(replies, FIO_NBYTES, &bytes) == OK && bytes != 0) {
    if (take_reply(*this)) continue;
    logMsg("Problem while receiving a reply\n");
    mboxSkip(replies);
  }
}

Correspondence& own_correspondence() {
  auto& by_task = sync::state_of<Correspondences>(*sync::running_task().robot).by_task;
  return by_task[Tasks::here().self().id];
}

}  // namespace waitpoint::laas
