// SPDX-License-Identifier: BSD-3-Clause
#include "tools/view/history/cursors.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "tools/view/request.hpp"

namespace waitpoint::tools::view {
namespace {

constexpr std::size_t cursors_max = 24;
constexpr std::int64_t count_max = 1'000'000;  // of steps

}  // namespace

std::string text_for_copy(Json request, const std::string& what, Time end) {
  for (const char* key : {"time", "from", "to"})
    if (request.contains(key)) request[key] = std::min(time_in(request, key), end).ns();
  if (request.contains("times"))
    for (Json& time : request["times"]) time = std::min(time_of(time, "times"), end).ns();
  request["until"] = end.ns();
  request["do"] = what;
  request.erase("id");
  request.erase("ask");
  return text_of(request);
}

Cursors::~Cursors() {
  for (const auto& [key, cursor] : cursors_)
    if (cursor->peer) copies_.leave(cursor->peer);
}

// An old cursor serves if it stands before `time` and no snapshot is nearer.
Cursors::Cursor& Cursors::at(const Key& key, Time time) {
  const Origin origin = lines_.origin_before(key.second, time);
  const auto old = cursors_.find(key);
  if (old != cursors_.end() && old->second->time <= time && old->second->time >= origin.time &&
      (!old->second->is_made || (old->second->peer && old->second->peer->is_open())))
    return *old->second;
  return make(key, origin);
}

Cursors::Cursor& Cursors::make(const Key& key, const Origin& origin) {
  if (const auto old = cursors_.find(key); old != cursors_.end()) {
    if (old->second->peer) copies_.leave(old->second->peer);
    cursors_.erase(old);
  }
  if (cursors_.size() >= cursors_max) throw BadInput("the view", "there are too many viewers of the past");
  const auto cursor = std::make_shared<Cursor>();
  cursor->time = origin.time;
  cursors_[key] = cursor;
  const auto begin = [this, cursor](const std::shared_ptr<Peer>& peer) {
    cursor->peer = peer;
    cursor->is_made = true;
    for (auto& [request, reply] : std::exchange(cursor->waiting, {})) ask_at(*cursor, std::move(request), reply);
  };
  copies_.make(
      origin, [begin](const std::string&) { begin(nullptr); }, begin);
  return *cursor;
}

void Cursors::ask_at(Cursor& cursor, std::string request, const Reply& reply) {
  if (!cursor.is_made) {
    cursor.waiting.emplace_back(std::move(request), reply);
    return;
  }
  if (!cursor.peer) return reply(error_text("a copy of the run cannot be made"));
  cursor.peer->ask(std::move(request), [reply](Channel::Message* message) { reply(text_of_reply(message)); });
}

void Cursors::ask(Owner owner, const Json& request, const Reply& reply) {
  const Key key(owner, lines_.number_in(request));
  TimeLine& line = lines_[key.second];
  const std::string what = request.at("ask");
  const auto present = cursors_.find(key);
  const bool is_seek = what == "seek", is_new = present == cursors_.end();
  const std::int64_t count = what == "step" ? whole_number_in(request, "count", -count_max, count_max, 1) : 0;
  const Time time = is_seek  ? std::min(time_in(request, "time"), lines_.end(key.second))
                    : is_new ? line.reached
                             : present->second->time;
  Cursor& cursor = at(key, time);
  cursor.time = std::max(cursor.time, time);
  if (key.second > 0) line.reached = std::max(line.reached, time);
  if (!is_seek && is_new) ask_at(cursor, text_of(Json{{"do", "to"}, {"time", time.ns()}}), [](auto) {});
  if (count < 0) return step_back(key, request, cursor.events, reply);
  ask_at(cursor, text_for_copy(request, is_seek ? "to" : what, lines_.end(key.second)),
         is_seek || what == "step" ? noting(key, reply) : reply);
}

// Where the cursor is then is known from the reply.
Reply Cursors::noting(const Key& key, const Reply& reply) {
  return [this, key, reply](const std::string& text) {
    if (const auto now = cursors_.find(key); now != cursors_.end()) now->second->note(text);
    reply(text);
  };
}

// Members of a frame.
void Cursors::Cursor::note(const std::string& frame) {
  const auto number_after = [&frame](std::string_view name) -> std::int64_t {
    const std::size_t at = frame.find(name);
    return at != std::string::npos ? std::atoll(frame.c_str() + at + name.size()) : 0;
  };
  time = std::max(time, Time::from_ns(number_after("\"time\":")));
  events = static_cast<std::uint64_t>(number_after("\"events\":"));
}

void Cursors::go_to_event(const Key& key, std::uint64_t event, const Reply& reply) {
  const auto is_early = [event](const Snapshot& snapshot) { return snapshot.events <= event; };
  Cursor& cursor = make(key, lines_.origin(key.second, is_early));
  ask_at(cursor, text_of(Json{{"do", "to_event"}, {"event", event}, {"line", key.second}}), noting(key, reply));
}

// To the state after so many events fewer, or after so many fewer of one task, whose numbers a copy finds out.
void Cursors::step_back(const Key& key, const Json& request, std::uint64_t events, const Reply& reply) {
  const auto back = static_cast<std::uint64_t>(-request.at("count").get<std::int64_t>());
  if (!request.contains("task") || request["task"].is_null())
    return go_to_event(key, events > back ? events - back : 0, reply);
  const Json find = {{"do", "event_before"}, {"event", events}, {"task", request["task"]}, {"count", back}};
  copies_.make(lines_.origin_before(key.second, Time()), reply, [this, key, find, reply](const auto& peer) {
    peer->ask(text_of(find), [this, key, peer, reply](Channel::Message* message) {
      const Json found = Json::parse(text_of_reply(message));
      copies_.leave(peer);
      if (found.contains("error")) return reply(text_of(found));
      try {
        go_to_event(key, found.at("event").get<std::uint64_t>(), reply);
      } catch (const BadInput& refusal) {
        reply(error_text(refusal.what()));
      }
    });
  });
}

void Cursors::forget(Owner owner) {
  for (auto cursor = cursors_.begin(); cursor != cursors_.end();) {
    if (cursor->first.first != owner) {
      ++cursor;
      continue;
    }
    if (cursor->second->peer) copies_.leave(cursor->second->peer);
    cursor = cursors_.erase(cursor);
  }
}

}  // namespace waitpoint::tools::view
