// SPDX-License-Identifier: BSD-3-Clause
// A task's mailboxes, and the letters that it sent and that wait for replies.
//
//   FREE -> WAITING_INTERMED_REPLY -> WAITING_FINAL_REPLY -> FINAL_REPLY_OK -> FREE, when its state is asked for
//                 | time-out                 | time-out
//        INTERMED_REPLY_TIMEOUT     FINAL_REPLY_TIMEOUT: until the number is freed
#pragma once

#include <array>
#include <cstdint>
#include <map>

#include "fibers/sync/blocking.hpp"
#include "fibers/sync/robot_state.hpp"

#include "fibers/laas/include/gcomLib.h"

namespace waitpoint::laas {

struct Send {
  int state = FREE;
  std::int64_t sent = 0;  ///< the tick
  int intermediate_timeout = 0;
  int final_timeout = 0;
  LETTER_ID intermediate = nullptr;
  LETTER_ID final = nullptr;

  bool waits() const { return state == WAITING_INTERMED_REPLY || state == WAITING_FINAL_REPLY; }
  /// The ticks until the time-out of the reply that it waits for: 0 is without limit, less is past.
  int ticks_left() const;
  /// Its state, after the time-out if that is past.
  int check();
};

struct Correspondence {
  MBOX_ID received = 0;
  MBOX_ID replies = 0;
  std::array<Send, MAX_SEND> sends;

  /// Null, with S_gcomLib_ERR_SEND_ID, for a number that is none.
  Send* find(int send_id);
  /// Takes all replies that came into the letters that wait for them. Others are logged and discarded.
  void take_replies();
};

/// The caller's.
Correspondence& own_correspondence();

}  // namespace waitpoint::laas
