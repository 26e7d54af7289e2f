// SPDX-License-Identifier: BSD-3-Clause
// One direction between two robots: carries messages over the medium, as events of the sender. Within one robot a
// message arrives at once.
//
// A message's latency and loss are a function of (seed, sender, receiver, the message's number on this link) and of the
// distance at its sending: independent of other links' traffic.
#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "fibers/io/medium.hpp"
#include "fibers/kernel/scheduler.hpp"

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

class Link {
 public:
  /// Called when a message arrives, by the task that sent it or without a task: must neither block nor use the running
  /// task.
  using Arrival = std::function<void()>;

  /// Without `medium`: within one robot.
  Link(kernel::Scheduler& scheduler, kernel::Robot& from, std::string to, std::optional<Medium> medium,
       const Distance& distance, std::size_t in_flight_max);
  Link(const Link&) = delete;
  Link& operator=(const Link&) = delete;

  /// May be lost, or arrive before earlier messages.
  void send_datagram(std::size_t bytes, Arrival arrival);
  /// Arrives after all earlier messages sent in order; beyond the range it waits.
  void send_in_order(std::size_t bytes, Arrival arrival);

  /// The network is destroyed: nothing arrives any more, and sending is a misuse.
  void stop();

  /// True between robots: messages in transit then occupy room that the receiver cannot free at once.
  bool is_between_robots() const { return medium_.has_value(); }
  const std::string& to() const { return to_; }
  LinkStatistics statistics;

 private:
  struct Flight : kernel::EventNode {
    Link* link = nullptr;
    Arrival arrival;
  };
  struct RangeCheck : kernel::EventNode {
    Link* link = nullptr;
  };
  struct Waiting {
    std::size_t bytes;
    Arrival arrival;
  };

  static void land(kernel::EventNode& node);
  static void look_again(kernel::EventNode& node);
  void begin_sending();
  double distance_m() const;
  Duration latency() const;
  bool is_lost() const;
  Time put_on_air(std::size_t bytes, double distance_m);
  void transmit_in_order(std::size_t bytes, double distance_m, Arrival arrival);
  void check_room() const;
  void launch(Time arrives, Arrival arrival);

  kernel::Scheduler& scheduler_;
  kernel::Robot& from_;
  std::string to_;
  std::optional<Medium> medium_;
  const Distance& distance_;
  std::size_t in_flight_max_;
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
