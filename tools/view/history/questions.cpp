// SPDX-License-Identifier: BSD-3-Clause
#include "tools/view/history/questions.hpp"

#include <cstdint>

#include "tools/view/request.hpp"

namespace waitpoint::tools::view {
namespace {

constexpr std::size_t waiting_max = 64;
constexpr int at_once = 2;

}  // namespace

void Questions::ask(Owner owner, const Json& request, const Reply& reply) {
  if (waiting_.size() >= waiting_max) return reply(error_text("the view: there are too many questions at once"));
  waiting_.push_back({owner, request, reply});
  ask_next();
}

void Questions::ask_next() {
  while (under_way_ < at_once && !waiting_.empty()) {
    const Question next = std::move(waiting_.front());
    waiting_.pop_front();
    try {
      ask_now(next);
    } catch (const std::exception& refusal) {
      next.reply(error_text(refusal.what()));
    }
  }
}

Origin Questions::origin_of(const Json& request, std::size_t line) const {
  const std::string what = request.at("ask");
  if (what == "counts") return lines_.origin(line, [](const Snapshot&) { return true; });
  if (what != "stack") return lines_.origin_before(line, time_in(request, "from"));
  const auto event = static_cast<std::uint64_t>(whole_number_in(request, "event", 1, INT64_MAX));
  return lines_.origin(line, [event](const Snapshot& snapshot) { return snapshot.events < event; });
}

void Questions::ask_now(const Question& question) {
  const std::size_t line = lines_.number_in(question.request);
  const Origin origin = origin_of(question.request, line);
  Json request = question.request;
  if (request.at("ask") == "counts" && line > 0) request["time"] = lines_[line].reached.ns();
  const std::string text = text_for_copy(request, request.at("ask"), lines_.end(line));
  const auto end = [this, reply = question.reply](const std::string& answer) {
    --under_way_;
    reply(answer);
    ask_next();
  };
  ++under_way_;
  copies_.make(origin, end, [this, end, text](const std::shared_ptr<Peer>& peer) {
    peer->ask(text, [this, peer, end](Channel::Message* message) {
      const std::string answer = text_of_reply(message);
      copies_.leave(peer);
      end(answer);
    });
  });
}

}  // namespace waitpoint::tools::view
