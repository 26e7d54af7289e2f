// SPDX-License-Identifier: BSD-3-Clause
// The connections to copies of a run (run_copy.hpp), in the process of the viewer: nothing here waits.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/time.hpp"
#include "tools/view/history/peer.hpp"
#include "tools/view/view_json.hpp"

namespace waitpoint::tools::view {

/// Calls back when a descriptor can be read: the viewer's loop.
struct Loop {
  std::function<void(int descriptor, std::function<void()> ready)> watch;
  std::function<void(int descriptor)> forget;
};

/// Takes the text of a JSON object; with "error" if the request was refused.
using Reply = std::function<void(std::string text)>;
std::string error_text(const std::string& text);
/// The reply of a process, or why there is none.
std::string text_of_reply(Channel::Message* message);

/// An intervention with the step of the world at which it takes effect.
struct DatedText {
  std::string text;
  Time date;
};

/// Where a copy of a line of time comes from: a snapshot of it, or one of a line that it has left, before it did, with
/// the interventions that are still to come.
struct Origin {
  std::shared_ptr<Peer> peer;
  Time time;
  std::vector<DatedText> interventions = {};
};

class Copies {
 public:
  using Use = std::function<void(const std::shared_ptr<Peer>& peer)>;

  explicit Copies(Loop loop) : loop_(std::move(loop)) {}

  /// Takes up the connection to a process.
  std::shared_ptr<Peer> join(Channel channel);
  /// Its last owner then closes the channel, and the process ends.
  void leave(const std::shared_ptr<Peer>& peer) { loop_.forget(peer->number()); }
  /// Calls `use` with a new copy, that stands where its origin does; without one, `reply` says why.
  void make(const Origin& origin, const Reply& reply, Use use);

 private:
  Loop loop_;
};

}  // namespace waitpoint::tools::view
