// SPDX-License-Identifier: BSD-3-Clause
// A client of modules: sends requests and receives replies, as csLib does. Belongs to one task.
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

  /// Sends a request. Returns the number that its replies carry, or nothing if the module's mailbox is full. An unknown
  /// module or request is a bug.
  template <HasFields In = Nothing>
  std::optional<std::uint32_t> send(const std::string& module, const std::string& request, const In& input = {}) {
    return send(module, request, Payload(input));
  }

  /// Takes a request back that has not come to its module: a gate that holds it back replies ACTIVITY_INTERRUPTED. A
  /// request that has come there is replied to as ever, and ended by "Abort" with its activity's number.
  void withdraw(std::uint32_t send_id);

  /// The next reply to any request, or one without a number (send_id 0) after wake(); nothing after `timeout`
  /// (Duration::max(): no timeout; zero: does not block).
  std::optional<Reply> receive(Duration timeout = Duration::max());

  /// From any task: ends receive(), of the task that waits in it or of the next call.
  void wake();

  /// Sends a request and waits without limit for its final reply, which arrives even if the mailbox is full; other
  /// replies are dropped. For a limited wait, use send() and receive().
  template <HasFields In = Nothing>
  Reply call(const std::string& module, const std::string& request, const In& input = {}) {
    return call(module, request, Payload(input));
  }

  /// Ends a module in any state: aborts its activities, resumes suspended tasks, and ends it as soon as possible;
  /// Module::join() then waits for its tasks. False if an activity lasts longer than `patience`: the module then
  /// continues to run.
  bool end_module(const std::string& module, Duration patience = std::chrono::seconds(10));

  /// The same with the input already packed.
  std::optional<std::uint32_t> send(const std::string& module, const std::string& request, const Payload& input);
  Reply call(const std::string& module, const std::string& request, const Payload& input);

 private:
  NameSpace& names_;
  Mailbox mailbox_;
  std::uint32_t sent_ = 0;
};

}  // namespace waitpoint::genom
