// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/io/network.hpp"

#include "fibers/kernel/interruption.hpp"
#include "fibers/kernel/messages.hpp"
#include "fibers/kernel/run.hpp"

namespace waitpoint::io {
namespace {

std::pair<std::string, std::string> in_order(const std::string& a, const std::string& b) {
  return a < b ? std::pair(a, b) : std::pair(b, a);
}

kernel::Robot* robot_named(const kernel::Scheduler& scheduler, const std::string& name) {
  for (kernel::Robot* robot = kernel::roster(scheduler).first_robot(); robot != nullptr; robot = robot->next)
    if (name == robot->name) return robot;
  return nullptr;
}

}  // namespace

Address::Address(std::string_view text) {
  const std::size_t colon = text.rfind(':');
  if (colon != std::string_view::npos) robot = text.substr(0, colon);
  port = colon == std::string_view::npos ? text : text.substr(colon + 1);
}

std::string to_string(const Address& address) { return address.robot + ":" + address.port; }

Link* Node::link_to(std::string_view robot) {
  if (robot.empty()) robot = robot_.name;
  const auto known = links_.find(robot);
  if (known != links_.end()) return &known->second;
  const std::string to(robot);
  std::optional<Medium> medium;
  Node* receiver = this;
  if (to != robot_.name) {
    const Medium* declared = network_.medium(robot_.name, to);
    receiver = network_.node(to).get();
    if (declared == nullptr || receiver == nullptr) return nullptr;
    medium = *declared;
    network_.has_traffic_ = true;
  }
  const Forward* const forward = network_.is_elsewhere(to) ? &network_.forward_ : nullptr;
  return &links_
              .try_emplace(to, network_.scheduler_, robot_, to, *receiver, medium, network_.distance_,
                           network_.limits_.in_flight_max, forward)
              .first->second;
}

void Node::reseed() {
  for (auto& [to, link] : links_) link.reseed();
}

void Node::stop() {
  for (auto& [to, link] : links_) link.stop();
}

Channel* Node::find(Protocol protocol, const std::string& port) const {
  const auto found = ports_.find({protocol, port});
  return found != ports_.end() ? found->second : nullptr;
}

bool Node::bind(Protocol protocol, const std::string& port, Channel& channel) {
  WAITPOINT_REQUIRE(!port.empty() && port.find(':') == std::string::npos,
                    "a name to bind is empty or contains a colon");
  return ports_.try_emplace({protocol, port}, &channel).second;
}

bool Node::has_room() const { return sockets_.size() < network_.limits_.sockets_max; }

std::uint64_t Node::add_socket(Channel& socket) {
  WAITPOINT_REQUIRE(has_room(), "a robot has more sockets than NetworkLimits::sockets_max");
  sockets_.emplace_hint(sockets_.end(), ++last_socket_, &socket);
  return last_socket_;
}

Channel* Node::socket(std::uint64_t number) const {
  const auto found = sockets_.find(number);
  return found != sockets_.end() ? found->second : nullptr;
}

Parcels& Node::parcels() { return network_.parcels(); }

Network::Network(Simulation& simulation, NetworkLimits limits) : scheduler_(simulation.scheduler()), limits_(limits) {}

Network::Network() : scheduler_(*sync::running_task().scheduler) {}

Network::~Network() {
  for (const auto& [name, node] : nodes_) node->stop();
  // Outside tasks the run that uses the sockets may not be unwound yet, and tasks that cannot be unwound leave some
  // open.
  if (kernel::running == nullptr || kernel::is_unwinding(scheduler_)) return;
  for (const auto& [name, node] : nodes_)
    WAITPOINT_REQUIRE(node->sockets() == 0, "a network is destroyed before its sockets");
}

void Network::begin_declaring(const Medium& medium) {
  WAITPOINT_REQUIRE(!has_traffic_, "a medium is declared after robots have sent to each other");
  check(medium);
  kernel::declare_latency(scheduler_, medium.latency_least);
}

void Network::declare(const Medium& medium) {
  begin_declaring(medium);
  between_all_ = medium;
}

void Network::declare(const std::string& a, const std::string& b, const Medium& medium) {
  for (const std::string& name : {a, b})
    if (robot_named(scheduler_, name) == nullptr) throw BadInput("medium", "there is no robot '" + name + "'");
  if (a == b) throw BadInput("medium", "within robot '" + a + "' there is no medium");
  begin_declaring(medium);
  between_[in_order(a, b)] = medium;
}

void Network::set_elsewhere(std::set<std::string, std::less<>> robots, Forward forward) {
  WAITPOINT_REQUIRE(!has_traffic_, "robots are said to be elsewhere after they have sent to each other");
  elsewhere_ = std::move(robots);
  forward_ = std::move(forward);
}

void Network::arrive_at(Time time, const std::string& sender, std::uint64_t count, const std::string& to,
                        Packet packet) {
  const std::shared_ptr<Node> there = node(sender);
  Link* const link = there != nullptr && is_elsewhere(sender) ? there->link_to(to) : nullptr;
  WAITPOINT_CHECK(link != nullptr, "a packet comes from a robot that is not elsewhere, or over no link");
  link->arrive_at(time, count, std::move(packet));
}

const Medium* Network::medium(const std::string& from, const std::string& to) const {
  const auto special = between_.find(in_order(from, to));
  if (special != between_.end()) return &special->second;
  return between_all_ ? &*between_all_ : nullptr;
}

void Network::reseed() {
  for (const auto& [name, node] : nodes_) node->reseed();
}

LinkStatistics Network::statistics(const std::string& from, const std::string& to) {
  const std::shared_ptr<Node> sender = node(from);
  const Link* const link = sender != nullptr ? sender->link_to(to) : nullptr;
  return link != nullptr ? link->statistics : LinkStatistics();
}

std::shared_ptr<Node> Network::own_node() {
  const kernel::Robot& robot = *sync::running_task().robot;
  WAITPOINT_REQUIRE(robot.scheduler == &scheduler_, "a network of another run is used");
  return node(robot.name);
}

std::shared_ptr<Node> Network::node(const std::string& name) {
  const auto known = nodes_.find(name);
  if (known != nodes_.end()) return known->second;
  kernel::Robot* const robot = robot_named(scheduler_, name);
  if (robot == nullptr) return nullptr;
  return nodes_[name] = std::make_shared<Node>(*this, *robot);
}

}  // namespace waitpoint::io
