// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/links/air.hpp"

#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <new>

#include "core/error.hpp"
#include "core/random.hpp"
#include "fibers/kernel/messages.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/kernel/timers.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/descriptors/descriptors.hpp"
#include "fibers/posix/descriptors/partners.hpp"
#include "fibers/posix/family/turn.hpp"
#include "fibers/posix/links/robot_links.hpp"
#include "fibers/posix/links/stream_links.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/time/clocks.hpp"

namespace waitpoint::posix {
namespace {

/// Until a lost piece of a stream is sent again; each further loss doubles it, up to a limit.
constexpr Duration first_retry = Duration(std::chrono::milliseconds(200));
constexpr int retries_most = 8;
constexpr Duration look_for_room = Duration(std::chrono::milliseconds(1));
/// Random draws of a message: indices of its link's stream.
enum Draw : std::uint64_t { of_latency, of_loss };

/// A message that this process has sent.
struct AirFlight : kernel::EventNode {
  void (*arrive)(void*) = nullptr;
  void (*drop)(void*) = nullptr;
  void* message = nullptr;
  const family::Process* sender = nullptr;
  std::size_t bytes = 0;
  AirFlight *next = nullptr, *previous = nullptr;  ///< of all, or of those that wait
};

struct FlightList {
  AirFlight *first = nullptr, *last = nullptr;
  void add(AirFlight& flight) {
    flight.previous = last;
    (last == nullptr ? first : last->next) = &flight;
    last = &flight;
  }
  void remove(AirFlight& flight) {
    (flight.previous == nullptr ? first : flight.previous->next) = flight.next;
    (flight.next == nullptr ? last : flight.next->previous) = flight.previous;
    flight.next = flight.previous = nullptr;
  }
};

/// From this process to a robot.
struct AirRoute : kernel::EventNode {
  Time in_order_until;  ///< when the last piece of a stream arrives
  FlightList waiting;   ///< pieces beyond the range
};

Air* air = nullptr;
int own_robot = 0;
FlightList flights;
AirRoute routes[Air::robots_max];
kernel::EventNode room;

Air* take_air() {
  if (family::family == nullptr) return nullptr;
  void* known = family::common(family::Part::air, 0);
  if (known == nullptr && (known = family::common(family::Part::air, sizeof(Air))) != nullptr) new (known) Air();
  return static_cast<Air*>(known);
}

Time time_of_sender() {
  return kernel::running != nullptr ? kernel::local_time(*kernel::running) : kernel::global_time(record->scheduler());
}

bool is_between_robots(int to) { return own_robot != 0 && to != 0 && to != own_robot; }
bool are_linked(int to) { return is_between_robots(to) ? air->has_medium : air->delay > Duration(); }

int number_of(const void* robot) {
  const auto number = static_cast<const Air::Robot*>(robot) - air->robots;
  WAITPOINT_CHECK(number >= 0 && number < Air::robots_max, "a message goes to a robot that is not of the run");
  return static_cast<int>(number);
}

double distance_m(int to) {
  const Air::Robot &here = air->robots[own_robot], &there = air->robots[to];
  return std::sqrt((here.x_m - there.x_m) * (here.x_m - there.x_m) + (here.y_m - there.y_m) * (here.y_m - there.y_m));
}
bool is_in_range(int to) { return air->medium.range_m == 0 || distance_m(to) <= air->medium.range_m; }

Duration time_on_air(std::uint64_t bytes) {
  const std::uint64_t rate = air->medium.bandwidth_bit_s;
  return rate == 0 ? Duration() : Duration::from_ns(static_cast<std::int64_t>(bytes * 8'000'000'000U / rate));
}

/// One transmission over the medium.
struct Transmission {
  Time arrives;
  bool is_lost = false;
};
Transmission transmit(int to, std::size_t bytes, Time from) {
  const Air::Medium& medium = air->medium;
  Air::Link& link = air->links[own_robot][to];
  char source[16 + sizeof Air::Robot::name] = "medium to ";
  std::copy_n(air->robots[to].name, sizeof Air::Robot::name, source + 10);
  const RandomStream random(record->settings.seed, air->robots[own_robot].name, source);
  ++link.number;
  link.free_at = later(std::max(link.free_at, from), time_on_air(bytes));
  const auto spread = static_cast<std::uint64_t>((medium.latency_most - medium.latency_least).ns());
  const std::uint64_t drawn_ns = random.below(spread + 1, link.number, Draw::of_latency);
  const Duration latency = medium.latency_least + Duration::from_ns(static_cast<std::int64_t>(drawn_ns)) +
                           Duration::from_seconds(medium.latency_per_metre.seconds() * distance_m(to));
  return {later(link.free_at, latency), medium.loss > 0 && random.uniform(link.number, Draw::of_loss) < medium.loss};
}

void look_after_event() {
  look_at_descriptors();
  family::limit_window(record->scheduler());
}

void end_flight(AirFlight& flight, bool arrives) {
  flights.remove(flight);
  if (arrives) flight.arrive(flight.message);
  flight.drop(flight.message);
  std::free(&flight);
}

// In the child of a fork, the flights are its parent's.
void land(kernel::EventNode& node) {
  auto& flight = static_cast<AirFlight&>(node);
  end_flight(flight, flight.sender == family::own);
  family::limit_window(record->scheduler());
}

void launch(AirFlight& flight, Time arrives) {
  flights.add(flight);
  flight.fire = land;
  kernel::deliver(record->scheduler(), flight, arrives, record->robot);
}

void launch_in_order(int to, AirFlight& flight) {
  AirRoute& route = routes[to];
  Transmission sent = transmit(to, flight.bytes, time_of_sender());
  Duration pause = first_retry;
  for (int i = 0; i < retries_most && sent.is_lost; ++i, pause = pause + pause) {
    ++air->links[own_robot][to].sent_again;
    sent = transmit(to, flight.bytes, later(sent.arrives, pause));
  }
  route.in_order_until = std::max(route.in_order_until, sent.arrives);
  launch(flight, route.in_order_until);
}

void check_range(kernel::EventNode& node) {
  auto& route = static_cast<AirRoute&>(node);
  const auto to = static_cast<int>(&route - routes);
  if (!is_in_range(to))
    return kernel::deliver(record->scheduler(), route, later(time_of_sender(), air->medium.range_check), record->robot);
  while (AirFlight* const flight = route.waiting.first) {
    route.waiting.remove(*flight);
    launch_in_order(to, *flight);
  }
}

AirFlight* made(std::size_t bytes, void (*arrive)(void*), void (*drop)(void*), void* message) {
  void* const memory = std::malloc(sizeof(AirFlight));
  if (memory == nullptr) return nullptr;
  auto* const flight = new (memory) AirFlight();
  flight->arrive = arrive;
  flight->drop = drop;
  flight->message = message;
  flight->sender = family::own;
  flight->bytes = bytes;
  return flight;
}

bool carry_by_air(void*, const kernel::Robot&, const void* robot, std::size_t bytes, void (*arrive)(void*),
                  void (*drop)(void*), void* message) {
  const int to = number_of(robot);
  const bool is_over_medium = is_between_robots(to);
  const Time now = time_of_sender();
  Transmission sent{later(now, air->delay)};
  if (is_over_medium) {
    const Air::Medium& medium = air->medium;
    const Duration queued = std::max(air->links[own_robot][to].free_at, now) - now;
    sent.is_lost = medium.queue_bytes > 0 && queued > time_on_air(medium.queue_bytes);
    if (!sent.is_lost) sent = transmit(to, bytes, now);
    sent.is_lost = sent.is_lost || !is_in_range(to);
  }
  if (sent.is_lost) {
    ++air->links[own_robot][to].lost;
    drop(message);
    return true;
  }
  AirFlight* const flight = made(bytes, arrive, drop, message);
  if (flight == nullptr) return false;
  launch(*flight, sent.arrives);
  return true;
}

bool carry_in_order_by_air(void*, const kernel::Robot&, const void* robot, std::size_t bytes, void (*arrive)(void*),
                           void (*drop)(void*), void* message) {
  const int to = number_of(robot);
  AirFlight* const flight = made(bytes, arrive, drop, message);
  if (flight == nullptr) return false;
  AirRoute& route = routes[to];
  if (!is_between_robots(to)) {
    launch(*flight, later(time_of_sender(), air->delay));
  } else if (route.waiting.first == nullptr && is_in_range(to)) {
    launch_in_order(to, *flight);
  } else {
    route.waiting.add(*flight);
    route.fire = check_range;
    if (!route.in_list())
      kernel::deliver(record->scheduler(), route, later(time_of_sender(), air->medium.range_check), record->robot);
  }
  return true;
}

in_port_t port_of(const SocketAddress& address) {
  if (address.bytes.ss_family == AF_INET) return ntohs(reinterpret_cast<const sockaddr_in&>(address.bytes).sin_port);
  if (address.bytes.ss_family == AF_INET6) return ntohs(reinterpret_cast<const sockaddr_in6&>(address.bytes).sin6_port);
  return 0;
}

const void* find_by_port(const SocketAddress& address, int) {
  const in_port_t port = port_of(address);
  if (port == 0) return nullptr;
  const int to = air->owners[port];
  return are_linked(to) ? &air->robots[to] : nullptr;
}

void look_for_room_later() {
  room.fire = [](kernel::EventNode&) { look_after_event(); };
  if (!room.in_list())
    kernel::deliver(record->scheduler(), room, later(time_of_sender(), look_for_room), record->robot);
}

void let_all_arrive() {
  for (AirRoute& route : routes)
    while (AirFlight* const flight = route.waiting.first) {
      route.waiting.remove(*flight);
      flights.add(*flight);
    }
  while (AirFlight* const flight = flights.first) {
    if (flight->in_list()) kernel::cancel(record->scheduler(), *flight);
    end_flight(*flight, flight->sender == family::own);
  }
}

constexpr Carrier carrier_by_air{nullptr, carry_by_air, carry_in_order_by_air, find_by_port};

// The port is this process's.
void own_port(std::uint16_t port) { air->owners[port] = static_cast<std::uint8_t>(own_robot); }

void use_air() {
  after_own_port = own_port;
  set_carrier(&carrier_by_air);
  await_room = look_for_room_later;
  family::before_leaving = let_all_arrive;
}

}  // namespace

void begin_air() {
  if (family::family == nullptr || (air = static_cast<Air*>(family::common(family::Part::air, 0))) == nullptr) return;
  const char* const number = WAITPOINT_NEXT(getenv)(robot_variable);
  own_robot = number == nullptr ? 0 : std::clamp(std::atoi(number), 0, Air::robots_max - 1);
  use_air();
}

}  // namespace waitpoint::posix

using namespace waitpoint;
using namespace waitpoint::posix;

/// For the process that declares the medium, before it starts others: this program's, of robot 0. Null outside
/// `waitpoint exec`.
extern "C" [[gnu::visibility("default")]] Air* waitpoint_air() {
  if (air == nullptr && (air = take_air()) != nullptr) use_air();
  return air;
}
