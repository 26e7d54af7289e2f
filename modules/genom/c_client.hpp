// SPDX-License-Identifier: BSD-3-Clause
// A client of one module for C code, as GenoM's message libraries have it: the generated functions
// MODULERequestRqstSend, ReplyRcv, RqstAndAck and RqstAndRcv call it with packed inputs and unpack its outputs.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "modules/genom/client.hpp"

namespace waitpoint::genom {

class CClient {
 public:
  /// `owner` names its mailbox.
  CClient(NameSpace& names, const std::string& owner, std::string module)
      : client_(names, owner), module_(std::move(module)), exists_(names.find_module(module_) != nullptr) {}

  /// False if the robot has no such module.
  bool exists() const { return exists_; }

  /// Sends a request, of which `request_id` is the client's number; ERROR if the module's mailbox is full.
  int send(const char* request, const Payload& input, int* request_id);

  /// Looks for the replies to a request, and waits as `block` says: NO_BLOCK, BLOCK_ON_INTERMED_REPLY or
  /// BLOCK_ON_FINAL_REPLY, for at most `timeout`. Returns WAITING_INTERMED_REPLY, WAITING_FINAL_REPLY, FINAL_REPLY_OK
  /// (the output is unpacked then), FINAL_REPLY_TIMEOUT, or ERROR: an unknown number, or a report that is not 0.
  template <HasFields Out>
  int receive(int request_id, int block, Out* output, int* activity, int* report, Duration timeout = Duration::max()) {
    const int status = wait(request_id, block, timeout);
    const Replies* replies = find(request_id);
    if (replies == nullptr) return status;
    *activity = replies->activity;
    if (!replies->final) return status;
    *report = static_cast<int>(replies->final->report);
    if (output != nullptr && replies->final->output.holds<Out>()) *output = replies->final->output.as<Out>();
    replies_.erase(request_id);
    return *report == 0 ? status : -1;
  }

 private:
  struct Replies {
    bool started = false;  ///< the intermediate reply has come
    int activity = -1;
    std::optional<Reply> final;
  };

  const Replies* find(int request_id) const;
  int wait(int request_id, int block, Duration timeout);
  bool take(Duration timeout);

  Client client_;
  std::string module_;
  bool exists_;
  std::map<int, Replies> replies_;  // of requests without a final reply taken
};

}  // namespace waitpoint::genom
