// SPDX-License-Identifier: BSD-3-Clause
#include "modules/genom/c_client.hpp"

#include "modules/genom/codels.h"

namespace waitpoint::genom {

int CClient::send(const char* request, const Payload& input, int* request_id) {
  const std::optional<std::uint32_t> id = client_.send(module_, request, input);
  if (!id) return ERROR;
  *request_id = static_cast<int>(*id);
  replies_[*request_id] = {};
  return OK;
}

const CClient::Replies* CClient::find(int request_id) const {
  const auto found = replies_.find(request_id);
  return found == replies_.end() ? nullptr : &found->second;
}

// Takes the next reply to any request; false if none comes in time.
bool CClient::take(Duration timeout) {
  const std::optional<Reply> reply = client_.receive(timeout);
  if (!reply) return false;
  const auto found = replies_.find(static_cast<int>(reply->send_id));
  if (found == replies_.end()) return true;
  if (reply->activity >= 0) found->second.activity = reply->activity;
  found->second.started = true;
  if (reply->final) found->second.final = *reply;
  return true;
}

int CClient::wait(int request_id, int block, Duration timeout) {
  const Replies* replies = find(request_id);
  if (replies == nullptr) return ERROR;
  const auto awaited = [&] {
    return block == NO_BLOCK || (block == BLOCK_ON_INTERMED_REPLY && replies->started) || replies->final.has_value();
  };
  while (take(Duration())) {
  }
  const Time begin = threads::now();
  while (!awaited()) {
    const Duration remaining = timeout == Duration::max() ? timeout : timeout - (threads::now() - begin);
    if (remaining <= Duration() || !take(remaining))
      return replies->started ? FINAL_REPLY_TIMEOUT : INTERMED_REPLY_TIMEOUT;
  }
  if (replies->final) return FINAL_REPLY_OK;
  return replies->started ? WAITING_FINAL_REPLY : WAITING_INTERMED_REPLY;
}

}  // namespace waitpoint::genom
