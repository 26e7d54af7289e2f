// SPDX-License-Identifier: BSD-3-Clause
#include "tools/view/history/history.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace waitpoint::tools::view {
namespace {

constexpr std::size_t snapshots_max = 48, lines_max = 32, cursors_max = 24, questions_max = 64;
// Each takes a processor.
constexpr int at_once = 2;

std::string error_text(const std::string& text) { return text_of(Json{{"error", text}}); }

/// The reply of a process, or why there is none.
std::string text_of_reply(Channel::Message* message) {
  return message != nullptr ? std::move(message->text)
                            : error_text("the run dies on the way there: see what it wrote when it was run");
}

std::string without_view_members(Json request, const char* what) {
  request["do"] = what;
  request.erase("id");
  request.erase("ask");
  return text_of(request);
}

}  // namespace

History::~History() {
  for (const Line& line : lines_)
    for (const Snapshot& snapshot : line.snapshots) loop_.forget(snapshot.peer->number());
  for (const auto& [key, cursor] : cursors_)
    if (cursor->peer) loop_.forget(cursor->peer->number());
}

std::shared_ptr<Peer> History::join(Channel channel) {
  auto peer = std::make_shared<Peer>(std::move(channel));
  loop_.watch(peer->number(), [this, peer] {
    peer->take_replies();
    if (!peer->is_open()) loop_.forget(peer->number());
  });
  return peer;
}

// The last owner of a peer closes its channel, and the process ends.
void History::leave(const std::shared_ptr<Peer>& peer) { loop_.forget(peer->number()); }

void History::add_snapshot(Time time, std::uint64_t events, Channel channel) {
  Line& line = lines_.front();
  line.snapshots.push_back({time, events, join(std::move(channel))});
  line.reached = std::max(line.reached, time);
  if (line.snapshots.size() > snapshots_max) thin_out(line);
}

// Every second one, but not the first and the last.
void History::thin_out(Line& line) {
  std::vector<Snapshot> kept;
  for (std::size_t i = 0; i < line.snapshots.size(); ++i) {
    const bool stays = i % 2 == 0 || i + 1 == line.snapshots.size() || !line.snapshots[i].peer->is_idle();
    if (stays)
      kept.push_back(line.snapshots[i]);
    else
      leave(line.snapshots[i].peer);
  }
  line.snapshots = std::move(kept);
}

History::Line& History::line_of(const Json& request) {
  const std::size_t number = request.value("line", std::size_t{0});
  if (number >= lines_.size()) throw BadInput("the view", "there is no line of time of this number");
  return lines_[number];
}

// Or the first one.
const History::Snapshot& History::last_snapshot(const Line& line,
                                                const std::function<bool(const Snapshot&)>& is_early) const {
  const Snapshot* found = nullptr;
  for (const Snapshot& snapshot : line.snapshots)
    if (snapshot.peer->is_open() && (found == nullptr || is_early(snapshot))) found = &snapshot;
  if (found == nullptr) throw BadInput("the view", "there is no snapshot of this run");
  return *found;
}

const History::Snapshot& History::snapshot_before(const Line& line, Time time) const {
  return last_snapshot(line, [time](const Snapshot& snapshot) { return snapshot.time <= time; });
}

// Without a copy, the reply says so.
void History::copy(const Snapshot& from, const Reply& reply, Use use) {
  from.peer->ask(R"({"do":"fork"})", [this, reply, use = std::move(use)](Channel::Message* made) {
    if (made == nullptr || made->descriptor.number() < 0) return reply(error_text("a copy of the run cannot be made"));
    use(join(Channel(std::move(made->descriptor))));
  });
}

// An old cursor serves if it stands before `time` and no snapshot is nearer.
History::Cursor& History::cursor_at(const CursorKey& key, const Line& line, Time time) {
  const Snapshot& snapshot = snapshot_before(line, time);
  const auto old = cursors_.find(key);
  if (old != cursors_.end() && old->second->time <= time && old->second->time >= snapshot.time &&
      (!old->second->is_made || old->second->peer->is_open()))
    return *old->second;
  return new_cursor(key, snapshot);
}

History::Cursor& History::new_cursor(const CursorKey& key, const Snapshot& from) {
  if (const auto old = cursors_.find(key); old != cursors_.end()) {
    if (old->second->peer) leave(old->second->peer);
    cursors_.erase(old);
  }
  if (cursors_.size() >= cursors_max) throw BadInput("the view", "there are too many viewers of the past");
  const auto cursor = std::make_shared<Cursor>();
  cursor->time = from.time;
  cursors_[key] = cursor;
  const auto begin = [this, cursor](const std::shared_ptr<Peer>& peer) {
    cursor->peer = peer;
    cursor->is_made = true;
    for (auto& [request, reply] : std::exchange(cursor->waiting, {})) ask(*cursor, std::move(request), reply);
  };
  copy(
      from, [begin](const std::string&) { begin(nullptr); }, begin);
  return *cursor;
}

void History::ask(Cursor& cursor, std::string request, const Reply& reply) {
  if (!cursor.is_made) {
    cursor.waiting.emplace_back(std::move(request), reply);
    return;
  }
  if (!cursor.peer) return reply(error_text("a copy of the run cannot be made"));
  cursor.peer->ask(std::move(request), [reply = reply](Channel::Message* message) { reply(text_of_reply(message)); });
}

void History::ask_cursor(Owner owner, const Json& request, const Reply& reply) {
  Line& line = line_of(request);
  const std::string what = request.at("ask");
  const CursorKey key(owner, static_cast<int>(&line - lines_.data()));
  const auto present = cursors_.find(key);
  const bool is_seek = what == "seek";
  const Time time = is_seek                     ? std::max(time_in(request, "time"), Time())
                    : present != cursors_.end() ? present->second->time
                                                : line.reached;
  Cursor& cursor = cursor_at(key, line, time);
  cursor.time = std::max(cursor.time, time);
  if (&line != &lines_.front()) line.reached = std::max(line.reached, time);
  if (!is_seek && present == cursors_.end()) ask(cursor, text_of(Json{{"do", "to"}, {"time", time.ns()}}), [](auto) {});
  if (what == "step") {
    const auto count = request.value("count", std::int64_t{1});
    if (count < 0) return step_back(key, request, cursor.events, reply);
  }
  ask(cursor, without_view_members(request, is_seek ? "to" : what.c_str()),
      is_seek || what == "step" ? noting(key, reply) : reply);
}

// Where the cursor is then is known from the reply.
History::Reply History::noting(const CursorKey& key, const Reply& reply) {
  return [this, key, reply](const std::string& text) {
    if (const auto now = cursors_.find(key); now != cursors_.end()) now->second->note(text);
    reply(text);
  };
}

// Members of a frame.
void History::Cursor::note(const std::string& frame) {
  const auto number_after = [&frame](std::string_view name) -> std::int64_t {
    const std::size_t at = frame.find(name);
    return at != std::string::npos ? std::atoll(frame.c_str() + at + name.size()) : 0;
  };
  time = std::max(time, Time::from_ns(number_after("\"time\":")));
  events = static_cast<std::uint64_t>(number_after("\"events\":"));
}

void History::go_to_event(const CursorKey& key, std::uint64_t event, const Reply& reply) {
  const auto is_early = [event](const Snapshot& snapshot) { return snapshot.events <= event; };
  const Line& line = lines_[static_cast<std::size_t>(key.second)];
  Cursor& cursor = new_cursor(key, last_snapshot(line, is_early));
  ask(cursor, text_of(Json{{"do", "to_event"}, {"event", event}, {"line", key.second}}), noting(key, reply));
}

// To the state after so many events fewer, or after so many fewer of one task, whose numbers a copy finds out.
void History::step_back(const CursorKey& key, const Json& request, std::uint64_t events, const Reply& reply) {
  const auto back = static_cast<std::uint64_t>(-request.at("count").get<std::int64_t>());
  if (!request.contains("task") || request["task"].is_null())
    return go_to_event(key, events > back ? events - back : 0, reply);
  const Json find = {{"do", "event_before"}, {"event", events}, {"task", request["task"]}, {"count", back}};
  const Snapshot& first = lines_[static_cast<std::size_t>(key.second)].snapshots.front();
  copy(first, reply, [this, key, find, reply](const std::shared_ptr<Peer>& peer) {
    peer->ask(text_of(find), [this, key, peer, reply](Channel::Message* message) {
      const Json found = Json::parse(text_of_reply(message));
      leave(peer);
      if (found.contains("error")) return reply(text_of(found));
      try {
        go_to_event(key, found.at("event").get<std::uint64_t>(), reply);
      } catch (const BadInput& refusal) {
        reply(error_text(refusal.what()));
      }
    });
  });
}

void History::ask_once(Owner owner, const Json& request, const Reply& reply) {
  if (questions_.size() >= questions_max) return reply(error_text("the view: there are too many questions at once"));
  questions_.push_back({owner, request, reply});
  ask_next();
}

void History::ask_next() {
  while (under_way_ < at_once && !questions_.empty()) {
    const Question next = std::move(questions_.front());
    questions_.pop_front();
    try {
      ask_now(next);
    } catch (const std::exception& refusal) {
      next.reply(error_text(refusal.what()));
    }
  }
}

void History::ask_now(const Question& question) {
  const Json& request = question.request;
  const std::string what = request.at("ask");
  const Line& line = line_of(request);
  const auto is_early = [&](const Snapshot& snapshot) {
    if (what == "stack") return snapshot.events < request.at("event").get<std::uint64_t>();
    return what == "counts" || snapshot.time <= time_in(request, "from");
  };
  const Snapshot& snapshot = last_snapshot(line, is_early);
  const auto end = [this, reply = question.reply](const std::string& text) {
    --under_way_;
    reply(text);
    ask_next();
  };
  ++under_way_;
  copy(snapshot, end,
       [this, end, text = without_view_members(request, what.c_str())](const std::shared_ptr<Peer>& peer) {
         peer->ask(text, [this, peer, end](Channel::Message* message) {
           const std::string reply = text_of_reply(message);
           leave(peer);
           end(reply);
         });
       });
}

void History::branch(const Json& request, const Reply& reply) {
  if (lines_.size() >= lines_max) throw BadInput("the view", "there are too many lines of time");
  const Line& parent = line_of(request);
  const Time time = std::max(time_in(request, "time"), Time());
  Line line{.name = "branch " + std::to_string(lines_.size()),
            .parent = static_cast<int>(&parent - lines_.data()),
            .from = time,
            .reached = time};
  auto texts = request.at("interventions").get<std::vector<std::string>>();
  copy(snapshot_before(parent, time), reply, [this, line, time, texts, reply](const std::shared_ptr<Peer>& peer) {
    peer->ask(text_of(Json{{"do", "to"}, {"time", time.ns()}}), [=, this](Channel::Message* message) {
      if (message == nullptr) return reply(text_of_reply(message));
      intervene(peer, texts, line, reply);
    });
  });
}

// One after the other; the first that is refused ends the attempt.
void History::intervene(const std::shared_ptr<Peer>& peer, std::vector<std::string> texts, const Line& line,
                        const Reply& reply) {
  if (texts.empty()) return add_line(peer, line, reply);
  const std::string next = texts.front();
  texts.erase(texts.begin());
  peer->ask(text_of(Json{{"do", "intervene"}, {"text", next}}), [=, this](Channel::Message* message) {
    if (message != nullptr && !Json::parse(message->text).contains("error")) return intervene(peer, texts, line, reply);
    reply(text_of_reply(message));
    leave(peer);
  });
}

void History::add_line(const std::shared_ptr<Peer>& peer, Line line, const Reply& reply) {
  peer->ask(R"({"do":"events_so_far"})", [=, this](Channel::Message* message) mutable {
    if (message == nullptr) return reply(text_of_reply(message));
    line.snapshots.push_back({line.from, Json::parse(message->text).at("events").get<std::uint64_t>(), peer});
    lines_.push_back(std::move(line));
    reply(text_of(Json{{"line", lines_.size() - 1}}));
  });
}

void History::forget(Owner owner) {
  questions_.remove_if([owner](const Question& question) { return question.owner == owner; });
  for (auto cursor = cursors_.begin(); cursor != cursors_.end();) {
    if (cursor->first.first != owner) {
      ++cursor;
      continue;
    }
    if (cursor->second->peer) leave(cursor->second->peer);
    cursor = cursors_.erase(cursor);
  }
}

History::Span History::apart(std::size_t line, std::size_t other) const {
  const auto [first, second] = std::minmax(line, other);
  if (second >= lines_.size()) throw BadInput("the view", "there is no line of time of this number");
  // Branches come after the line that they leave; the way up from the second may have several.
  for (int up = static_cast<int>(second); up >= 0; up = lines_[static_cast<std::size_t>(up)].parent) {
    const Line& branch = lines_[static_cast<std::size_t>(up)];
    if (branch.parent != static_cast<int>(first)) continue;
    return {lines_[second].from, std::min(lines_[first].reached, lines_[second].reached)};
  }
  throw BadInput("the view", "expected a line and a branch of it");
}

Json History::lines() const {
  Json list = Json::array();
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const Line& line = lines_[i];
    list.push_back({{"line", i},
                    {"from", line.from.ns()},
                    {"to", line.reached.ns()},
                    {"parent", line.parent >= 0 ? Json(line.parent) : Json(nullptr)},
                    {"name", line.name}});
  }
  return list;
}

}  // namespace waitpoint::tools::view
