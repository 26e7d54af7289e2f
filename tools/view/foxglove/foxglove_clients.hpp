// SPDX-License-Identifier: BSD-3-Clause
// The viewers of a run that speak Foxglove's WebSocket protocol (subprotocols foxglove.websocket.v1 and
// foxglove.sdk.v1): what they are sent, and what they may ask for. JSON texts with a member "op", and bytes that begin
// with an operation code; numbers are little-endian.
//
//   to a client      serverInfo, advertise, status; 1: message (subscription u32, time u64 in ns, payload);
//                    2: time (u64 in ns), before the messages of it
//   from a client    subscribe, unsubscribe; all else is answered by a status
//
// It knows no sockets. A client that has too much to take gets fewer messages, and is told. After the run, what it
// published last is still to be had.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tools/view/foxglove/topic_news.hpp"
#include "tools/view/view_json.hpp"

namespace waitpoint::tools::view {

class FoxgloveClients {
 public:
  using Client = std::uint64_t;
  /// What leads to the clients, and to the run: {"do":"topics","wanted":[...],"asked":[...]} (live_topics.hpp).
  struct Wires {
    std::function<void(Client client, std::string data, bool is_text)> send;
    std::function<std::size_t(Client client)> queued;  ///< bytes that it has not taken yet
    std::function<void(const std::string& request)> ask_run;
  };
  enum class Level : std::uint8_t { information, warning, error };

  /// `session` differs from that of all other servers.
  FoxgloveClients(std::string name, std::string session, Wires wires)
      : name_(std::move(name)), session_(std::move(session)), wires_(std::move(wires)) {}

  void opened(Client client);
  void closed(Client client);
  void received(Client client, const std::string& data, bool is_text);

  /// From the run.
  void take(TopicNews news);
  /// The run has come so far.
  void set_time(Time time) { time_ = time; }
  /// Tells the time to those who have been sent no messages of it.
  void tell_time();
  /// There will be no more news.
  void end_run(const std::string& outcome, Level level);

 private:
  using Topic = TopicNews::Topic;
  using Subscription = std::uint32_t;
  struct Subscribed {
    Subscription number = 0;
    bool is_current = false;  // has got what there was when it began
  };
  struct Session {
    std::map<Topic, Subscribed> topics;
    std::optional<Time> time;  // that it knows
    std::size_t left_out = 0;  // messages
    bool is_slow = false;
  };

  void answer(Client client, const Json& request);
  void subscribe(Client client, const Json& request);
  void unsubscribe(Client client, const Json& request);
  void want(const std::vector<Topic>& asked);
  void send_what_was_last(Client client, Topic topic);
  void send_current(const TopicNews& news);
  void send_step(Client client, Session& session, const TopicNews::Message& message);
  void send_message(Client client, Session& session, Subscription subscription, const TopicNews::Message& message);
  void send_time(Client client, Session& session, Time time);
  bool has_room(Client client, Session& session);
  void advertise(Client client, std::size_t first) const;
  void tell(Client client, Level level, const std::string& text, const char* id = nullptr) const;

  std::string name_, session_;
  Wires wires_;
  std::vector<TopicNews::Announced> topics_;
  std::map<Topic, std::vector<TopicNews::Message>> last_;
  std::map<Client, Session> sessions_;
  Time time_;
  bool is_over_ = false;
};

}  // namespace waitpoint::tools::view
