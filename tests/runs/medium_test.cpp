// SPDX-License-Identifier: BSD-3-Clause
// Two robots send each other the distances that they have driven, over the medium of their scenario. One drives away:
// latency, loss and range apply, by the true distance.
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "fibers/io/datagram_socket.hpp"
#include "fibers/kernel/messages.hpp"
#include "modules/genom/module.hpp"
#include "modules/posters/base.hpp"
#include "modules/run/experiment.hpp"
#include "modules/scenario/scenario_reader.hpp"
#include "tests/tools/folder.hpp"

namespace waitpoint::runs {
namespace {

using namespace std::chrono_literals;

struct Heard {
  std::uint64_t count = 0;
  Time sent, received;            // of the last message
  std::int64_t travel_units = 0;  // of the other robot, by its own odometry
  static void fields(auto field) {
    field("count", &Heard::count);
    field("sent", &Heard::sent);
    field("received", &Heard::received);
    field("travel_units", &Heard::travel_units);
  }
};

struct Told {
  io::Status status = io::Status::ok;  // of the last message sent
  static void fields(auto field) { field("status", &Told::status); }
};

struct BeaconParameters {
  double v_m_s = 0;
  bool sends = false;
  static void fields(auto field) {
    field("v_m_s", &BeaconParameters::v_m_s);
    field("sends", &BeaconParameters::sends);
  }
};

/// Drives straight on, sends its distance to robot "two", and receives.
class Beacon : public genom::Module {
 public:
  explicit Beacon(genom::ModuleSetup& setup)
      : Module(setup, 91),
        network_(*setup.network),
        task_(add_task("main", {.period_ms = 20ms})),
        reading_(read_poster<posters::BaseReading>("reading")) {
    setup.settings.read(parameters_);
    command_.v_m_s = parameters_.v_m_s;
    add_poster<posters::BaseCommand>("command", task_, &command_);
    add_poster<Heard>("heard", task_, &heard_);
    add_poster<Told>("told", task_, &told_);
    task_.set_permanent([this] { tell(), listen(); });
  }

 private:
  struct Message {
    std::int64_t sent_ns, travel_units;
  };

  void tell() {
    if (!socket_.is_open()) {
      socket_ = io::datagram_socket(network_);
      EXPECT_EQ(socket_.bind("beacon"), io::Status::ok);
    }
    posters::BaseReading reading;
    if (!parameters_.sends || reading_.read(reading) != genom::PosterStatus::ok) return;
    const Message message{threads::now().ns(), reading.travel_units};
    told_.status = socket_.send_to("two:beacon", std::as_bytes(std::span(&message, 1)));
  }
  void listen() {
    Message message{};
    while (socket_.receive(std::as_writable_bytes(std::span(&message, 1)), io::no_wait)) {
      ++heard_.count;
      heard_.sent = Time::from_ns(message.sent_ns);
      heard_.received = threads::now();
      heard_.travel_units = message.travel_units;
    }
  }

  io::Network& network_;
  BeaconParameters parameters_;
  genom::ExecutionTask& task_;
  genom::PosterLink<posters::BaseReading>& reading_;
  posters::BaseCommand command_;
  Heard heard_;
  Told told_;
  io::datagram_socket socket_;
};

const std::string text = R"(format: 1
until_s: 20
robot_types:
  scout:
    shape: {radius_m: 0.26, height_m: 1.2}
    base: {kind: differential}
    modules: [{name: beacon}]
    bridge:
      - {poster: beacon.command, device: base.command}
      - {poster: beacon.reading, device: base.reading}
robots:
  - {name: one, type: scout, start: [0, 0, 0], modules: [{name: beacon, v_m_s: 0.5, sends: true}]}
  - {name: two, type: scout, start: [-2, 0, 180]}
  - {name: far, type: scout, start: [500, 0, 0]}
)";

struct Transmission {
  Heard heard;
  io::Status told = io::Status::ok;  // to robot one, for its last message
  io::LinkStatistics statistics;
  std::vector<std::string> digests;
  std::string digest;
  Duration lookahead;
  double distance_m = 0;
};

template <class T>
T last(const run::Experiment& experiment, std::size_t robot, const std::string& poster) {
  return *dynamic_cast<genom::Poster<T>&>(*experiment.robots()[robot]->names().find_poster(poster)).look();
}

// Ten seconds, in which robot one drives 5 m less the distance lost while accelerating.
// `reseed`: from the first step on.
Transmission transmit(const std::string& medium, std::uint64_t seed = 1, const std::string& without = "",
                      std::optional<std::uint64_t> reseed = std::nullopt) {
  const tools::Folder folder;
  folder.write("s.yaml", text + medium);
  scenario::Scenario scenario = scenario::read_scenario(folder / "s.yaml");
  std::erase_if(scenario.robots, [&](const auto& robot) { return robot.name == without; });
  const std::vector<genom::ModuleType> types = {genom::module_type<Beacon>("beacon")};
  run::Experiment experiment(scenario, types, {seed, kernel::Order::fifo, ""});
  if (reseed) experiment.intervene(run::parse_intervention("seed " + std::to_string(*reseed), {"test", 0}));
  experiment.run_before(Time() + Duration(10s));
  Transmission outcome;
  outcome.heard = last<Heard>(experiment, 1, "beacon.heard");
  outcome.told = last<Told>(experiment, 0, "beacon.told").status;
  outcome.statistics = experiment.network().statistics("one", "two");
  const bridge::RunResult result = experiment.result();
  for (const bridge::RobotResult& robot : result.robots) outcome.digests.push_back(to_string(robot.digest));
  outcome.digest = to_string(result.digest);
  outcome.lookahead = kernel::lookahead(experiment.simulation().scheduler());
  const auto position = [&](std::uint32_t i) { return experiment.world().body(world::BodyId(i)).pose.position(); };
  outcome.distance_m = length(position(0) - position(1));
  return outcome;
}

TEST(MediumOfAScenario, DelaysWhatRobotsTellEachOther) {
  const Transmission outcome = transmit("medium: {latency_ms: 30}\n");
  EXPECT_EQ(outcome.lookahead, Duration(30ms));
  EXPECT_GT(outcome.statistics.sent, 490u);
  EXPECT_GE(outcome.heard.count + 3, outcome.statistics.sent);
  EXPECT_GT(outcome.heard.travel_units, 0);
  EXPECT_EQ(outcome.heard.received - outcome.heard.sent, Duration(40ms)) << "it listens every 20 ms";
}

TEST(MediumOfAScenario, LosesDatagrams) {
  const Transmission outcome = transmit("medium: {latency_ms: [5, 15], loss: 0.3}\n");
  EXPECT_NEAR(static_cast<double>(outcome.statistics.lost), 150, 45);
  EXPECT_GE(outcome.heard.count + outcome.statistics.lost + 2, outcome.statistics.sent);
}

TEST(MediumOfAScenario, EndsAtItsRangeByTheTrueDistance) {
  const Transmission outcome = transmit("medium: {latency_ms: 5, range_m: 4}\n");
  ASSERT_GT(outcome.distance_m, 6) << "robot one has not driven away";
  // 2 m at 0.5 m/s, and the time to accelerate.
  EXPECT_NEAR(outcome.heard.sent.seconds(), 4.3, 0.4);
  EXPECT_EQ(outcome.heard.count + outcome.statistics.out_of_range, outcome.statistics.sent);
}

TEST(MediumOfAScenario, WithoutOneRobotsCannotSend) {
  const Transmission outcome = transmit("");
  EXPECT_EQ(outcome.told, io::Status::no_route);
  EXPECT_EQ(outcome.heard.count, 0u);
  EXPECT_EQ(outcome.lookahead, Duration::max());
}

TEST(MediumOfAScenario, TheSameSeedGivesTheSameDigestsAndAnotherOnlyOtherLosses) {
  const std::string medium = "medium: {latency_ms: [5, 60], loss: 0.3, bandwidth_bit_s: 100000}\n";
  const Transmission first = transmit(medium), second = transmit(medium), other = transmit(medium, 2);
  EXPECT_EQ(second.digest, first.digest);
  EXPECT_EQ(second.heard.count, first.heard.count);
  EXPECT_NE(other.digest, first.digest);
}

TEST(MediumOfAScenario, LosesAndDelaysAsWithAnotherSeedFromAnInstantOn) {
  const std::string medium = "medium: {latency_ms: [5, 60], loss: 0.3}\n";
  EXPECT_EQ(transmit(medium, 1, "", 2).digests, transmit(medium, 2).digests);
  EXPECT_NE(transmit(medium, 1, "", 2).digests, transmit(medium, 1).digests);
}

TEST(MediumOfAScenario, RobotWithoutMessagesChangesNoOther) {
  const std::string medium = "medium: {latency_ms: [5, 60], loss: 0.3}\n";
  const Transmission all = transmit(medium), without = transmit(medium, 1, "far");
  ASSERT_EQ(all.digests.size(), 3u);
  EXPECT_EQ(std::vector<std::string>(all.digests.begin(), all.digests.begin() + 2), without.digests);
}

}  // namespace
}  // namespace waitpoint::runs
