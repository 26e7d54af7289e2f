// SPDX-License-Identifier: BSD-3-Clause
#include "tools/view/history/history.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "tools/view/request.hpp"

namespace waitpoint::tools::view {

History::~History() {
  for (const TimeLine& line : lines_.all())
    for (const Snapshot& snapshot : line.snapshots) copies_.leave(snapshot.peer);
}

void History::add_snapshot(Time time, std::uint64_t events, std::uint64_t copied_bytes, Channel channel) {
  lines_.add_snapshot({time, events, copies_.join(std::move(channel))}, copied_bytes,
                      [this](const std::shared_ptr<Peer>& peer) { copies_.leave(peer); });
}

void History::forget(Owner owner) {
  questions_.forget(owner);
  cursors_.forget(owner);
}

// Before its start a line is the one that it leaves.
void History::branch(const Json& request, const Reply& reply) {
  const Time time = time_in(request, "time");
  const std::size_t parent = lines_.line_at(lines_.number_in(request, "line"), time);
  if (time > lines_.end(parent)) throw BadInput("the view", "expected a time that the run has reached");
  const TimeLine line{.name = "branch " + std::to_string(lines_.size()),
                      .parent = static_cast<int>(parent),
                      .from = time,
                      .reached = time};
  const Json texts = request.value("interventions", Json());
  if (!texts.is_array() || !std::all_of(texts.begin(), texts.end(), [](const Json& text) { return text.is_string(); }))
    throw BadInput("the view", "expected interventions, a list of texts");
  lines_.check_room();
  copies_.make(lines_.origin_before(parent, time), reply,
               [this, line, texts = texts.get<std::vector<std::string>>(), reply](const std::shared_ptr<Peer>& peer) {
                 peer->ask(text_of(Json{{"do", "to"}, {"time", line.from.ns()}}), [=, this](Channel::Message* message) {
                   if (message == nullptr) return reply(text_of_reply(message));
                   intervene(peer, texts, line, reply);
                 });
               });
}

// One after the other; the first that is refused ends the attempt.
void History::intervene(const std::shared_ptr<Peer>& peer, std::vector<std::string> texts, TimeLine line,
                        const Reply& reply) {
  if (texts.empty()) return add_line(peer, std::move(line), reply);
  const std::string next = texts.front();
  texts.erase(texts.begin());
  peer->ask(text_of(Json{{"do", "intervene"}, {"text", next}}), [=, this](Channel::Message* message) mutable {
    const Json done = message != nullptr ? Json::parse(message->text) : Json::object();
    if (!done.contains("date")) {
      reply(text_of_reply(message));
      return copies_.leave(peer);
    }
    line.interventions.push_back({next, time_in(done, "date")});
    intervene(peer, std::move(texts), std::move(line), reply);
  });
}

// Others may have become lines meanwhile.
void History::add_line(const std::shared_ptr<Peer>& peer, TimeLine line, const Reply& reply) {
  peer->ask(R"({"do":"events_so_far"})", [=, this](Channel::Message* message) mutable {
    if (message == nullptr) return reply(text_of_reply(message));
    line.snapshots.push_back({line.from, Json::parse(message->text).at("events").get<std::uint64_t>(), peer});
    try {
      reply(text_of(Json{{"line", lines_.add(std::move(line))}}));
    } catch (const BadInput& refusal) {
      copies_.leave(peer);
      reply(error_text(refusal.what()));
    }
  });
}

}  // namespace waitpoint::tools::view
