// SPDX-License-Identifier: BSD-3-Clause
// A client of modules: sends requests and gets the replies, as csLib does. Belongs to one task.
#pragma once

#include <optional>
#include <string>

#include "modules/genom/mailbox.hpp"
#include "modules/genom/module.hpp"
#include "modules/genom/name_space.hpp"

namespace waitpoint::genom {

struct Reply {
  std::uint32_t send_id = 0;
  bool final = false;
  std::int32_t activity = -1;
  Report report = ok;
  Payload output;
};

class Client {
 public:
  Client(NameSpace& names, std::string owner) : names_(names), mailbox_(std::move(owner)) {}

  /// Sends a request; the number that its replies will bear, or nothing if the module's mailbox is full. A module or a
  /// request that does not exist is a bug.
  template <HasFields In = Nothing>
  std::optional<std::uint32_t> send(const std::string& module, const std::string& request, const In& input = {}) {
    return send(module, request, Payload(input));
  }

  /// The next reply to any request; nothing if none comes within `timeout` (Duration::max(): for ever, zero: does not
  /// wait).
  std::optional<Reply> receive(Duration timeout = Duration::max());

  /// Sends a request and waits for its final reply, which comes however many others are unread; those are dropped. To
  /// wait for a limited time, send() and receive().
  template <HasFields In = Nothing>
  Reply call(const std::string& module, const std::string& request, const In& input = {}) {
    return call(module, request, Payload(input));
  }

  /// Ends a module, whatever it does: aborts its activities, resumes its tasks where they are suspended, and ends it as
  /// soon as it can be; Module::join() then waits for its tasks. False if an activity goes on for longer than
  /// `patience`: the module then runs on.
  bool end_module(const std::string& module, Duration patience = std::chrono::seconds(10));

  /// The same with an input made before.
  std::optional<std::uint32_t> send(const std::string& module, const std::string& request, const Payload& input);
  Reply call(const std::string& module, const std::string& request, const Payload& input);

 private:
  NameSpace& names_;
  Mailbox mailbox_;
  std::uint32_t sent_ = 0;
};

}  // namespace waitpoint::genom
