// SPDX-License-Identifier: BSD-3-Clause
#include "tools/view/history/copies.hpp"

namespace waitpoint::tools::view {

std::string error_text(const std::string& text) { return text_of(Json{{"error", text}}); }

std::string text_of_reply(Channel::Message* message) {
  return message != nullptr ? std::move(message->text)
                            : error_text("the run dies on the way there: see what it wrote when it was run");
}

std::shared_ptr<Peer> Copies::join(Channel channel) {
  auto peer = std::make_shared<Peer>(std::move(channel));
  loop_.watch(peer->number(), [this, peer] {
    peer->take_replies();
    if (!peer->is_open()) loop_.forget(peer->number());
  });
  return peer;
}

// Interventions that are known before their time are the same as those that were made then.
void Copies::make(const Origin& origin, const Reply& reply, Use use) {
  origin.peer->ask(R"({"do":"fork"})",
                   [this, reply, interventions = origin.interventions, use = std::move(use)](Channel::Message* made) {
                     if (made == nullptr || made->descriptor.number() < 0)
                       return reply(error_text("a copy of the run cannot be made"));
                     const std::shared_ptr<Peer> peer = join(Channel(std::move(made->descriptor)));
                     for (const DatedText& one : interventions)
                       peer->ask(text_of(Json{{"do", "intervene"}, {"text", one.text}, {"date", one.date.ns()}}),
                                 [](Channel::Message*) {});
                     use(peer);
                   });
}

}  // namespace waitpoint::tools::view
