// SPDX-License-Identifier: BSD-3-Clause
// The network of a run: the names of sockets and mailboxes on each robot, and the links between robots.
//
//   io::Network network(simulation);
//   network.declare({.latency_least = 2ms, .latency_most = 5ms, .loss = 0.01});     // between all robots
//   network.declare("ada", "bob", {.latency_least = 40ms, .latency_most = 40ms});   // except between these
//
// No medium applies within a robot. Robots without a declared medium have no route. A network belongs to one run;
// nothing is sent after its destruction.
//
// Where the robots' tasks are distributed over several processes, each has the records of all robots, and a network:
//
//   network.set_elsewhere({"bob"}, forward);                // in ada's process: what is sent to bob leaves it
//   network.arrive_at(time, "ada", count, "bob", packet);   // in bob's
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "fibers/io/channel.hpp"
#include "fibers/io/link.hpp"
#include "fibers/io/parcels.hpp"
#include "fibers/sync/simulation.hpp"

namespace waitpoint::io {

/// A destination: a robot's name and a name there.
struct Address {
  Address() = default;
  /// "ada:door", or "door" on the caller's own robot.
  Address(std::string_view text);
  Address(const char* text) : Address(std::string_view(text)) {}
  Address(const std::string& text) : Address(std::string_view(text)) {}
  Address(std::string of, std::string name) : robot(std::move(of)), port(std::move(name)) {}

  std::string robot;  ///< empty: the caller's own
  std::string port;
  friend bool operator==(const Address&, const Address&) = default;
};

/// "ada:door".
std::string to_string(const Address& address);

/// Bounds on what a program can make grow; exceeding one is reported as a misuse.
struct NetworkLimits {
  std::size_t sockets_max = 4096;     ///< of one robot, connections and mailbox senders included
  std::size_t in_flight_max = 65536;  ///< messages in transit from one robot to another
};

/// Each has a name space of its own.
enum class Protocol : std::uint8_t { datagram, stream, mailbox };

class Network;

/// One robot's part of the network. Its sockets share ownership: they may be closed after the network's destruction.
class Node final : public Receiver {
 public:
  Node(Network& network, kernel::Robot& robot) : network_(network), robot_(robot) {}

  /// See Network::reseed().
  void reseed();
  /// The network is destroyed: messages in transit never arrive.
  void stop();

  std::string name() const { return robot_.name; }
  /// The link to a robot, which may be this one; null if there is no route.
  Link* link_to(std::string_view robot);
  /// Calls the handler of the packet's kind.
  void receive(Link& link, Packet& packet) override;
  /// Null if the name is not bound.
  Channel* find(Protocol protocol, const std::string& port) const;
  /// False if the name is in use.
  bool bind(Protocol protocol, const std::string& port, Channel& channel);
  void release(Protocol protocol, const std::string& port) { ports_.erase({protocol, port}); }
  /// Numbers a socket or mailbox sender; beyond NetworkLimits::sockets_max is a misuse.
  std::uint64_t add_socket(Channel& socket);
  void remove_socket(std::uint64_t number) { sockets_.erase(number); }
  /// Null if it was removed.
  Channel* socket(std::uint64_t number) const;
  std::size_t sockets() const { return sockets_.size(); }
  bool has_room() const;
  Parcels& parcels();

 private:
  Network& network_;
  kernel::Robot& robot_;
  std::map<std::pair<Protocol, std::string>, Channel*> ports_;
  std::map<std::string, Link, std::less<>> links_;
  std::map<std::uint64_t, Channel*> sockets_;
  std::uint64_t last_socket_ = 0;
};

class Network {
 public:
  explicit Network(Simulation& simulation, NetworkLimits limits = {});
  /// The network of the running task's simulation.
  Network();
  ~Network();
  Network(const Network&) = delete;
  Network& operator=(const Network&) = delete;

  /// Declares the medium between all robots. Must precede all messages between robots; an invalid one is BadInput.
  void declare(const Medium& medium);
  /// Declares the medium between two robots, in both directions, instead of the general one.
  void declare(const std::string& a, const std::string& b, const Medium& medium);
  /// The distance of two robots; zero if not set.
  void set_distance(Distance metres) { distance_ = std::move(metres); }

  /// Messages sent from now on have the latencies and losses of the chooser's present seed.
  void reseed();

  /// The tasks of these robots run in other processes: packets to them go to `forward`. Must precede all messages.
  void set_elsewhere(std::set<std::string, std::less<>> robots, Forward forward);
  bool is_elsewhere(std::string_view robot) const { return elsewhere_.contains(robot); }
  /// A packet that the process with the sender's tasks has forwarded, with the arguments of its Forward: it arrives as
  /// if the sender were here.
  void arrive_at(Time time, const std::string& sender, std::uint64_t count, const std::string& to, Packet packet);
  /// The objects that parcels refer to.
  Parcels& parcels() { return parcels_; }

  /// Counts of all messages that a robot has sent to another. Of several processes, those that happened in this one:
  /// datagrams to an unbound name are counted at their arrival, the others when they are sent.
  LinkStatistics statistics(const std::string& from, const std::string& to);

  /// For sockets: the node of the running task's robot.
  std::shared_ptr<Node> own_node();
  /// Null if there is no robot of that name.
  std::shared_ptr<Node> node(const std::string& robot);

 private:
  friend class Node;
  void begin_declaring(const Medium& medium);
  const Medium* medium(const std::string& from, const std::string& to) const;

  kernel::Scheduler& scheduler_;
  NetworkLimits limits_;
  Distance distance_;
  std::set<std::string, std::less<>> elsewhere_;
  Forward forward_;
  Parcels parcels_;
  bool has_traffic_ = false;  // messages were sent between robots
  std::optional<Medium> between_all_;
  std::map<std::pair<std::string, std::string>, Medium> between_;  // robots' names in order
  std::map<std::string, std::shared_ptr<Node>> nodes_;
};

}  // namespace waitpoint::io
