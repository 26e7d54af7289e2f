// SPDX-License-Identifier: BSD-3-Clause
// A gate before the modules of one robot: the one place through which the requests of all clients pass. Without a gate
// a request goes straight to its module's mailbox.
#pragma once

#include "modules/genom/mailbox.hpp"

namespace waitpoint::genom {

class Module;

class RequestGate {
 public:
  virtual ~RequestGate() = default;
  /// Takes a request to `module` over from a client's task; false if there is no room for it, as of a full mailbox.
  virtual bool post(Module& module, const Letter& request) = 0;
  /// A request that the gate still holds back gets the final reply ACTIVITY_INTERRUPTED, and never comes to its module;
  /// nothing for one that has passed, or ended. From the client's task, after its post().
  virtual void withdraw(const Letter& withdrawal) = 0;
};

}  // namespace waitpoint::genom
