// SPDX-License-Identifier: BSD-3-Clause
#include "tools/view/foxglove/foxglove_clients.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "core/error.hpp"

namespace waitpoint::tools::view {
namespace {

// A client with more than the first of these to take gets no further messages until it has less than the second.
constexpr std::size_t foxglove_queued_max = 4 << 20, queued_again = 1 << 20;
constexpr char message_code = 1, time_code = 2;
constexpr const char* slow = "slow";  // a status of an id takes the place of the one before

template <class Number>
void append(std::string& bytes, Number number) {
  for (std::size_t i = 0; i < sizeof number; ++i) bytes += static_cast<char>(number >> (8 * i));
}

/// A whole number of 32 bits, which is called `name`.
std::uint32_t number_of(const Json& json, const char* name) {
  if (!json.is_number_unsigned() || json.get<std::uint64_t>() > 0xffffffff)
    throw BadInput("the request", std::string("expected '") + name + "' as a number from 0 to 4294967295");
  return json.get<std::uint32_t>();
}

std::uint32_t number_in(const Json& object, const char* name) {
  return number_of(object.is_object() && object.contains(name) ? object[name] : Json(), name);
}

const Json& list_in(const Json& request, const char* name) {
  const auto found = request.find(name);
  if (found == request.end() || !found->is_array())
    throw BadInput("the request", std::string("expected a list '") + name + "'");
  return *found;
}

}  // namespace

void FoxgloveClients::opened(Client client) {
  sessions_[client];
  const Json info{{"op", "serverInfo"},
                  {"name", name_},
                  {"capabilities", Json::array({"time"})},
                  {"metadata", Json::object()},
                  {"sessionId", session_}};
  wires_.send(client, text_of(info), true);
  if (!topics_.empty()) advertise(client, 0);
}

void FoxgloveClients::closed(Client client) {
  sessions_.erase(client);
  want({});
}

void FoxgloveClients::received(Client client, const std::string& data, bool is_text) {
  try {
    if (!is_text) throw BadInput("the request", "this server takes no binary messages");
    answer(client, Json::parse(data, nullptr, false));
  } catch (const std::exception& refusal) {
    if (wires_.queued(client) <= foxglove_queued_max) tell(client, Level::error, refusal.what());
  }
}

void FoxgloveClients::answer(Client client, const Json& request) {
  const auto op = request.is_object() ? request.find("op") : request.end();
  if (op == request.end() || !op->is_string()) throw BadInput("the request", "expected a JSON object with 'op'");
  if (*op == "subscribe") return subscribe(client, request);
  if (*op == "unsubscribe") return unsubscribe(client, request);
  throw BadInput("the request", "expected subscribe or unsubscribe, found '" + op->get<std::string>() + "'");
}

void FoxgloveClients::subscribe(Client client, const Json& request) {
  Session& session = sessions_.at(client);
  std::set<Subscription> numbers;
  for (const auto& [topic, subscribed] : session.topics) numbers.insert(subscribed.number);
  std::vector<Topic> asked;
  for (const Json& each : list_in(request, "subscriptions")) {
    const Subscription number = number_in(each, "id");
    const std::uint32_t topic = number_in(each, "channelId");
    const std::string which = "subscription " + std::to_string(number);
    if (topic >= topics_.size())
      tell(client, Level::error, which + ": there is no channel " + std::to_string(topic));
    else if (numbers.contains(number))
      tell(client, Level::error, which + " exists");
    else if (!session.topics.try_emplace(static_cast<Topic>(topic), Subscribed{number}).second)
      tell(client, Level::error, which + ": there is another one of channel " + std::to_string(topic));
    else {
      asked.push_back(static_cast<Topic>(topic));
      numbers.insert(number);
    }
  }
  if (asked.empty()) return;
  if (!is_over_) return want(asked);
  for (const Topic topic : asked) send_what_was_last(client, topic);
}

void FoxgloveClients::unsubscribe(Client client, const Json& request) {
  Session& session = sessions_.at(client);
  for (const Json& each : list_in(request, "subscriptionIds")) {
    const Subscription number = number_of(each, "subscriptionIds");
    const std::size_t ended = std::erase_if(session.topics, [&](const auto& of) { return of.second.number == number; });
    if (ended == 0) tell(client, Level::error, "there is no subscription " + std::to_string(number));
  }
  want({});
}

void FoxgloveClients::want(const std::vector<Topic>& asked) {
  if (is_over_) return;
  std::set<Topic> wanted;
  for (const auto& [client, session] : sessions_)
    for (const auto& [topic, subscribed] : session.topics) wanted.insert(topic);
  wires_.ask_run(text_of(Json{{"do", "topics"}, {"wanted", wanted}, {"asked", asked}}));
}

void FoxgloveClients::take(TopicNews news) {
  if (!news.added.empty()) {
    const std::size_t first = topics_.size();
    for (TopicNews::Announced& topic : news.added) topics_.push_back(std::move(topic));
    for (const auto& [client, session] : sessions_) advertise(client, first);
  }
  if (!news.trouble.empty())
    for (const auto& [client, session] : sessions_) tell(client, Level::error, news.trouble);
  if (news.kind == TopicNews::Kind::steps)
    for (const TopicNews::Message& message : news.messages)
      for (auto& [client, session] : sessions_) send_step(client, session, message);
  if (news.kind == TopicNews::Kind::current) send_current(news);
  // What was published together is kept together: all frames of one instant, not only the last one.
  std::map<Topic, std::vector<TopicNews::Message>> latest;
  for (TopicNews::Message& message : news.messages) latest[message.topic].push_back(std::move(message));
  for (auto& [topic, messages] : latest) last_[topic] = std::move(messages);
}

void FoxgloveClients::send_current(const TopicNews& news) {
  for (auto& [client, session] : sessions_) {
    for (const TopicNews::Message& message : news.messages)
      if (const auto found = session.topics.find(message.topic);
          found != session.topics.end() && !found->second.is_current)
        send_message(client, session, found->second.number, message);
    for (const Topic topic : news.asked)
      if (const auto found = session.topics.find(topic); found != session.topics.end()) found->second.is_current = true;
  }
}

void FoxgloveClients::send_step(Client client, Session& session, const TopicNews::Message& message) {
  const auto found = session.topics.find(message.topic);
  if (found == session.topics.end() || !found->second.is_current) return;
  if (!has_room(client, session))
    ++session.left_out;
  else
    send_message(client, session, found->second.number, message);
}

bool FoxgloveClients::has_room(Client client, Session& session) {
  const std::size_t queued = wires_.queued(client);
  if (queued <= (session.is_slow ? queued_again : foxglove_queued_max)) {
    if (std::exchange(session.is_slow, false))
      tell(client, Level::warning,
           std::to_string(session.left_out) + " messages were left out: this client does not take them fast enough",
           slow);
    return true;
  }
  if (!std::exchange(session.is_slow, true))
    tell(client, Level::warning, "messages are left out: this client does not take them fast enough", slow);
  return false;
}

void FoxgloveClients::send_what_was_last(Client client, Topic topic) {
  Session& session = sessions_.at(client);
  Subscribed& subscribed = session.topics.at(topic);
  subscribed.is_current = true;
  if (const auto found = last_.find(topic); found != last_.end())
    for (const TopicNews::Message& message : found->second) send_message(client, session, subscribed.number, message);
}

void FoxgloveClients::send_message(Client client, Session& session, Subscription subscription,
                                   const TopicNews::Message& message) {
  send_time(client, session, message.time);
  std::string bytes{message_code};
  bytes.reserve(sizeof message_code + sizeof subscription + sizeof(std::uint64_t) + message.text.size());
  append(bytes, subscription);
  append(bytes, static_cast<std::uint64_t>(message.time.ns()));
  wires_.send(client, bytes + message.text, false);
}

// Time never goes back, though messages may be older.
void FoxgloveClients::send_time(Client client, Session& session, Time time) {
  if (session.time && *session.time >= time) return;
  session.time = time;
  std::string bytes{time_code};
  append(bytes, static_cast<std::uint64_t>(time.ns()));
  wires_.send(client, std::move(bytes), false);
}

void FoxgloveClients::tell_time() {
  for (auto& [client, session] : sessions_)
    if (!session.is_slow && wires_.queued(client) <= foxglove_queued_max) send_time(client, session, time_);
}

void FoxgloveClients::end_run(const std::string& outcome, Level level) {
  if (std::exchange(is_over_, true)) return;
  for (auto& [client, session] : sessions_) {
    tell(client, level, "the run is over: " + outcome);
    for (auto& [topic, subscribed] : session.topics)
      if (!subscribed.is_current) send_what_was_last(client, topic);
  }
}

void FoxgloveClients::advertise(Client client, std::size_t first) const {
  Json channels = Json::array();
  for (std::size_t i = first; i < topics_.size(); ++i)
    channels.push_back({{"id", i},
                        {"topic", topics_[i].name},
                        {"encoding", "json"},
                        {"schemaName", topics_[i].schema.name},
                        {"schema", topics_[i].schema.text},
                        {"schemaEncoding", "jsonschema"}});
  wires_.send(client, text_of(Json{{"op", "advertise"}, {"channels", std::move(channels)}}), true);
}

void FoxgloveClients::tell(Client client, Level level, const std::string& text, const char* id) const {
  Json status{{"op", "status"}, {"level", static_cast<int>(level)}, {"message", text}};
  if (id != nullptr) status["id"] = id;
  wires_.send(client, text_of(status), true);
}

}  // namespace waitpoint::tools::view
