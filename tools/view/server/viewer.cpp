// SPDX-License-Identifier: BSD-3-Clause
#include "tools/view/server/viewer.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "tools/output/progress.hpp"
#include "tools/view/frame_reader.hpp"
#include "tools/view/history/comparison.hpp"
#include "tools/view/page.hpp"
#include "tools/view/request.hpp"
#include "tools/view/server/token.hpp"

namespace waitpoint::tools::view {
namespace {

constexpr int look_ms = 5, status_ms = 100;
constexpr double frames_s_max = 60;
// A client with more than this to take gets no further frames until it has taken them.
constexpr std::size_t queued_max = 1 << 20;
constexpr std::size_t log_bytes_max = 4 << 20;

/// A reply with the number of its request.
std::string with_id(const Json& id, const std::string& text) {
  return "{\"id\":" + text_of(id) + (text == "{}" ? "" : ",") + text.substr(1);
}

}  // namespace

Viewer::Viewer(const ViewerOptions& options, Channel run)
    : options_(options),
      run_(std::move(run)),
      server_({options.address, options.port, make_token(), page()},
              {.opened = [this](ClientNumber client) { clients_[client]; },
               .closed =
                   [this](ClientNumber client) {
                     clients_.erase(client);
                     history_.forget(client);
                   },
               .received = [this](ClientNumber client, const std::string& text) { received(client, text); }},
              "--serve"),
      history_({[this](int descriptor, std::function<void()> ready) { server_.watch(descriptor, std::move(ready)); },
                [this](int descriptor) { server_.forget(descriptor); }},
               options.until) {
  server_.watch(run_.number(), [this] { take_from_run(); });
}

void Viewer::serve(const std::function<bool()>& is_over) {
  server_.repeat(look_ms, [this] { ask_for_frame(); });
  server_.repeat(status_ms, [this, &is_over] {
    if (is_over()) return server_.stop();
    send_status();
  });
  server_.run();
}

void Viewer::take_from_run() {
  while (auto message = run_.poll()) take(*message);
  if (run_.is_open()) return;
  server_.forget(run_.number());
  // Without its last status: it has died.
  if (!run_is_over_) {
    status_["over"] = true;
    status_["outcome"] = "crashed";
  }
  run_is_over_ = true;
}

void Viewer::take(Channel::Message& message) {
  constexpr std::string_view frame = "{\"kind\":\"frame\"";
  if (message.text.starts_with(frame)) {
    frame_is_due_ = false;
    return send_frame(message.text);
  }
  if (message.text.starts_with("{\"kind\":\"header\"")) {
    robots_ = Json::parse(message.text).at("robots").size();
    scene_ = std::move(message.text);
    for (auto& [number, client] : clients_)
      if (client.header) send_header(number, std::exchange(client.header, nullptr));
    return;
  }
  Json json = Json::parse(message.text);
  if (json["kind"] == "snapshot") {
    const std::size_t before = history_.snapshots();
    history_.add_snapshot(Time::from_ns(json["time"].get<std::int64_t>()), json["events"], json["copied"],
                          Channel(std::move(message.descriptor)));
    if (history_.snapshots() < before) run_.queue(R"({"do":"thin"})");
  } else if (json["kind"] == "status") {
    history_.set_reached(Time::from_ns(json["time"].get<std::int64_t>()));
    run_is_over_ = json["over"];
    status_ = std::move(json);
  } else if (json["kind"] == "log") {
    if (log_.size() < log_bytes_max)
      for (const Json& line : json["lines"]) log_ += (log_.empty() ? "" : ",") + text_of(line);
    send_to_all(message.text);
  }
}

bool Viewer::is_ready(ClientNumber number, const Client& client, double now_s) const {
  return client.follows && now_s >= client.next_s && server_.queued(number) <= queued_max;
}

// One frame at a time is asked for, when a client that follows is ready for it. Parts that several want differently are
// shown in full.
void Viewer::ask_for_frame() {
  run_.flush();
  if (frame_is_due_ || run_is_over_) return;
  const double now_s = wall_clock_s();
  Json request = nullptr;
  bool whole = false;
  for (const auto& [number, client] : clients_) {
    if (!is_ready(number, client, now_s)) continue;
    whole = whole || client.is_behind;
    if (request.is_null()) {
      request = client.wants;
      continue;
    }
    request["scans"] = request["scans"] == true || client.wants["scans"] == true;
    for (const char* key : {"view", "robot"})
      if (request[key] != client.wants[key]) request[key] = nullptr;
  }
  if (request.is_null()) return;
  request["whole"] = whole;
  request["do"] = "frame";
  frame_is_due_ = true;
  run_.queue(text_of(request));
}

void Viewer::send_frame(const std::string& text) {
  const double now_s = wall_clock_s();
  const bool whole = text.find("\"whole\":true") != std::string::npos, news = text.ends_with("\"news\":true}");
  for (auto& [number, client] : clients_) {
    if (!is_ready(number, client, now_s) || (client.is_behind && !whole)) {
      client.is_behind = client.is_behind || news;
      continue;
    }
    client.is_behind = false;
    client.next_s = now_s + client.frame_s;
    server_.send(number, text);
  }
}

void Viewer::send_status() {
  if (status_.empty()) return;
  status_["lines"] = history_.lines();
  std::string text = text_of(status_);
  if (text == sent_status_) return;
  send_to_all(text);
  sent_status_ = std::move(text);
}

void Viewer::send_to_all(const std::string& text) {
  for (const auto& [number, client] : clients_)
    if (server_.queued(number) <= queued_max) server_.send(number, text);
}

void Viewer::received(ClientNumber client, const std::string& text) {
  Json id = nullptr;
  try {
    const Json request = read_request(text);
    id = request.value("id", Json(nullptr));
    answer(client, request, [this, client, id](const std::string& reply) { server_.send(client, with_id(id, reply)); });
  } catch (const std::exception& refusal) {
    server_.send(client, with_id(id, text_of(Json{{"error", refusal.what()}})));
  }
}

void Viewer::answer(ClientNumber client, const Json& request, const History::Reply& reply) {
  const std::string what = request.at("ask");
  const auto is_one_of = [&what](auto... names) { return ((what == names) || ...); };
  if (what == "header") {
    if (scene_.empty())
      clients_[client].header = reply;
    else
      send_header(client, reply);
    return;
  }
  if (what == "follow") {
    follow(clients_[client], request);
    return reply("{}");
  }
  if (what == "journal") return answer_journal(client, request, reply);
  if (is_one_of("seek", "step", "tasks", "modules")) return history_.ask_cursor(client, request, reply);
  if (is_one_of("events", "plot", "stack", "digests", "counts")) return history_.ask_once(client, request, reply);
  if (what == "compare") return compare(client, request, reply);
  if (!is_one_of("branch", "pause", "speed")) throw BadInput("the view", "there is no request '" + what + "'");
  if (!options_.is_controlled) throw BadInput("the view", "expected waitpoint run --serve-control for '" + what + "'");
  if (what == "branch") return history_.branch(request, reply);
  control(request, reply);
}

void Viewer::send_header(ClientNumber client, const History::Reply& reply) {
  reply(scene_);
  server_.send(client, "{\"kind\":\"log\",\"lines\":[" + log_ + "]}");
  sent_status_.clear();
  send_status();
}

void Viewer::compare(ClientNumber client, const Json& request, const History::Reply& reply) {
  const std::size_t line = history_.line_in(request, "line"), other = history_.line_in(request, "with");
  std::make_shared<Comparison>(history_, client, line, other)->begin(reply);
}

// With the command that repeats it.
void Viewer::answer_journal(ClientNumber client, const Json& request, const History::Reply& reply) {
  history_.ask_cursor(client, request, [reply, command = options_.replay_command](const std::string& text) {
    Json journal = Json::parse(text);
    if (!journal.contains("error")) journal["command"] = command + " --replay-journal FILE";
    reply(text_of(journal));
  });
}

void Viewer::follow(Client& client, const Json& request) {
  (void)frame_options(request, robots_);
  const Json rate = request.value("rate", Json(30.0));
  if (!rate.is_number()) throw BadInput("the view", "'rate': expected a number of frames a second");
  client.follows = flag_in(request, "on", true);
  client.is_behind = true;
  for (const char* key : {"view", "robot"}) client.wants[key] = request.value(key, Json(nullptr));
  client.wants["scans"] = flag_in(request, "scans", true);
  client.frame_s = 1 / std::clamp(rate.get<double>(), 0.1, frames_s_max);
}

void Viewer::control(const Json& request, const History::Reply& reply) {
  if (run_is_over_) throw BadInput("the view", "the run is over");
  Json passed = request;
  passed["do"] = request["ask"];
  if (request["ask"] == "speed") {
    const Json speed = request.value("value", Json());
    if (!speed.is_number() || !(speed >= 0 && speed <= 1e6))
      throw BadInput("the view", "expected a speed from 0 to 1000000");
  } else {
    (void)flag_in(request, "on");
  }
  run_.queue(text_of(passed));
  reply("{}");
}

}  // namespace waitpoint::tools::view
