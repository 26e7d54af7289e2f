// SPDX-License-Identifier: BSD-3-Clause
// One direction between two robots: carries packets over the medium, as events of the sender. Within one robot a packet
// arrives at once.
//
// A message's latency and loss are a function of (seed, sender, receiver, the message's number on this link) and of the
// distance at its sending: independent of other links' traffic.
#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/random.hpp"
#include "fibers/io/medium.hpp"
#include "fibers/io/packet.hpp"
#include "fibers/kernel/task.hpp"

namespace waitpoint::io {

/// The current distance in metres of two robots, by name.
using Distance = std::function<double(const std::string& from, const std::string& to)>;

/// Counts of the messages sent on a link.
struct LinkStatistics {
  std::uint64_t sent = 0;          ///< all messages
  std::uint64_t lost = 0;          ///< datagrams lost by the medium
  std::uint64_t out_of_range = 0;  ///< datagrams sent beyond the range
  std::uint64_t overflowed = 0;    ///< datagrams dropped at the sender's full queue
  std::uint64_t unreachable = 0;   ///< datagrams to an unbound name
};

class Link;

/// Where a link ends.
class Receiver {
 public:
  /// A packet arrives. Called by the task that sent it or without a task: must neither block nor use the running task.
  virtual void receive(Link& link, Packet& packet) = 0;

 protected:
  ~Receiver() = default;
};

/// Takes a packet to the process with the receiver's tasks. `count` is the number of messages of its sender so far.
using Forward = std::function<void(const kernel::Robot& sender, std::uint64_t count, Time arrives,
                                   const std::string& to, Packet packet)>;

class Link {
 public:
  /// Without `medium`: within one robot. With `forward` packets leave the process instead of arriving at `receiver`.
  Link(kernel::Scheduler& scheduler, kernel::Robot& from, std::string to, Receiver& receiver,
       std::optional<Medium> medium, const Distance& distance, std::size_t in_flight_max, const Forward* forward);
  Link(const Link&) = delete;
  Link& operator=(const Link&) = delete;

  /// The packet takes the time of `bytes` bytes. It may arrive before earlier ones, or be lost: false if it is.
  bool send_datagram(std::size_t bytes, Packet packet);
  /// Arrives after all earlier packets sent in order; beyond the range it waits.
  void send_in_order(std::size_t bytes, Packet packet);
  /// A packet that another process, with the sender's tasks, has sent over its own link and forwarded.
  void arrive_at(Time time, std::uint64_t count, Packet packet);

  /// Messages sent from now on have the latencies and losses of the chooser's present seed.
  void reseed();

  /// The network is destroyed: nothing arrives any more, and sending is a misuse.
  void stop();

  /// True between robots: messages in transit then occupy room that the receiver cannot free at once.
  bool is_between_robots() const { return medium_.has_value(); }
  std::string_view from() const { return from_.name; }
  const std::string& to() const { return to_; }
  LinkStatistics statistics;

 private:
  struct Flight : kernel::EventNode {
    Link* link = nullptr;
    Packet packet;
  };
  struct RangeCheck : kernel::EventNode {
    Link* link = nullptr;
  };
  struct Waiting {
    std::size_t bytes;
    Packet packet;
  };

  static void land(kernel::EventNode& node);
  static void look_again(kernel::EventNode& node);
  void begin_sending();
  double distance_m() const;
  Duration latency() const;
  bool is_lost() const;
  Time put_on_air(std::size_t bytes, double distance_m);
  void transmit_in_order(std::size_t bytes, double distance_m, Packet&& packet);
  void check_room() const;
  void launch(Time arrives, Packet&& packet);
  Flight& take_flight();

  kernel::Scheduler& scheduler_;
  kernel::Robot& from_;
  std::string to_;
  Receiver& receiver_;
  std::optional<Medium> medium_;
  const Distance& distance_;
  std::size_t in_flight_max_;
  const Forward* forward_;
  RandomStream random_;
  bool stopped_ = false;
  std::uint64_t number_ = 0;  // of the last transmitted message
  Time free_at_;              // when the last bit of all messages so far is transmitted
  Time in_order_until_;       // when the last message in order arrives
  std::deque<Waiting> waiting_;
  RangeCheck range_check_;
  std::deque<Flight> flights_;
  std::vector<Flight*> free_flights_;  // unused entries of flights_
};

}  // namespace waitpoint::io
