// SPDX-License-Identifier: BSD-3-Clause
// The module that lets two robots wait for each other: each tells the other by a letter over the medium that it is
// there, and waits for the other's. Simulated threads only: real robots have a medium of their own.
//
//   ada: Meet{bob, lobby} ---- letter {ada, lobby} ---> bob's mailbox "meeting"
//   bob: Meet{ada, lobby} <--- letter {bob, lobby} ----
//
//   requests Meet
#pragma once

#include <optional>
#include <vector>

#include "fibers/io/mailbox_sender.hpp"
#include "modules/genom/module.hpp"
#include "modules/posters/meeting.hpp"

namespace waitpoint::meeting {

class MeetingModule : public genom::Module {
 public:
  explicit MeetingModule(genom::ModuleSetup& setup);

 private:
  static constexpr std::size_t letters_max = 64;

  void tell(const posters::Meeting& with);
  bool has_come(const posters::Meeting& with);

  io::Network* network_;
  genom::ExecutionTask& task_;
  io::mailbox<posters::Meeting> letters_{letters_max, "meeting"};
  std::vector<posters::Meeting> come_;  // received, and not yet waited for
};

}  // namespace waitpoint::meeting
