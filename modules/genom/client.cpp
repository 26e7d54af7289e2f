// SPDX-License-Identifier: BSD-3-Clause
#include "modules/genom/client.hpp"

namespace waitpoint::genom {

std::optional<std::uint32_t> Client::send(const std::string& module, const std::string& request, const Payload& input) {
  Module* target = names_.find_module(module);
  WAITPOINT_CHECK(target != nullptr, "a request is sent to a module that does not exist");
  const RequestType* type = target->find_request(request);
  WAITPOINT_CHECK(type != nullptr, "a request is sent that the module does not have");
  Letter letter;
  letter.request = type->number;
  letter.send_id = ++sent_;
  letter.reply_to = &mailbox_;
  letter.payload = input;
  RequestGate* const gate = names_.gate();
  const bool is_posted = gate != nullptr ? gate->post(*target, letter) : target->mailbox().post(letter);
  if (!is_posted) return std::nullopt;
  return letter.send_id;
}

void Client::withdraw(std::uint32_t send_id) {
  if (names_.gate() == nullptr) return;
  Letter letter;
  letter.kind = LetterKind::withdrawal;
  letter.send_id = send_id;
  letter.reply_to = &mailbox_;
  names_.gate()->withdraw(letter);
}

std::optional<Reply> Client::receive(Duration timeout) {
  if (timeout == Duration::max())
    mailbox_.event().acquire();
  else if (!mailbox_.event().try_acquire_for(std::chrono::nanoseconds(timeout.ns())))
    return std::nullopt;
  Letter letter;
  const bool taken = mailbox_.take(letter);
  WAITPOINT_CHECK(taken, "a mailbox was signalled without a letter");
  return Reply{letter.send_id, letter.kind == LetterKind::final_reply, letter.activity, letter.report, letter.payload};
}

// A full mailbox has letters to wake for.
void Client::wake() {
  Letter letter;
  letter.kind = LetterKind::intermediate_reply;
  (void)mailbox_.post(letter);
}

Reply Client::call(const std::string& module, const std::string& request, const Payload& input) {
  const auto try_to_send = [&] {
    mailbox_.keep_room_for(sent_ + 1);
    return send(module, request, input);
  };
  std::optional<std::uint32_t> id;
  while (!(id = try_to_send())) threads::this_thread::sleep_for(std::chrono::milliseconds(1));
  for (;;) {
    const std::optional<Reply> reply = receive();
    if (reply->send_id == *id && reply->final) return *reply;
  }
}

bool Client::end_module(const std::string& module, Duration patience) {
  const auto* poster = dynamic_cast<Poster<ModuleStatus>*>(names_.find_poster(module + ".control"));
  WAITPOINT_CHECK(poster != nullptr, "a module is ended that does not exist");
  const Time begin = threads::now();
  while (call(module, "Abort", AbortInput{AbortInput::end_module}).report != ok) {
    if (threads::now() - begin > patience) return false;
    call(module, "Abort", AbortInput{AbortInput::resume_tasks});
    ModuleStatus status;
    poster->read(status);
    for (const ActivityStatus& activity : status.activities) call(module, "Abort", AbortInput{activity.number});
    threads::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return true;
}

}  // namespace waitpoint::genom
