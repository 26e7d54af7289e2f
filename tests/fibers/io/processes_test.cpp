// SPDX-License-Identifier: BSD-3-Clause
// A run over several processes: each robot does, receives and hashes what it does in a run in one.
#include "tests/fibers/io/processes.hpp"

#include <gtest/gtest.h>

#include "fibers/io/datagram_socket.hpp"
#include "fibers/io/mailbox_sender.hpp"
#include "fibers/io/stream_listener.hpp"
#include "tests/fibers/io/bytes.hpp"

namespace waitpoint::io {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;

constexpr Medium varying{.latency_least = Duration(1ms),
                         .latency_most = Duration(4ms),
                         .bandwidth_bit_s = 1'000'000,
                         .loss = 0.2,
                         .queue_bytes = 500};

void note(Log& log, const std::string& text) { log.push_back(to_string(now()) + " " + text); }
void note(Log& log, Status status) { note(log, to_string(status)); }

bool has(const Log& log, const std::string& text) {
  return std::any_of(log.begin(), log.end(), [&](const std::string& line) { return line.ends_with(" " + text); });
}

// The traces in one process, after a comparison with those in several, in some orders.
Traces expect_equal_in_processes(const Trial& trial, const std::vector<std::vector<std::string>>& groups) {
  std::vector<std::string> all;
  for (const auto& [name, body] : trial.bodies) all.push_back(name);
  Traces first;
  for (const std::uint64_t number : {0, 1, 2, 3, 4}) {
    const Traces in_one = run_in_processes(trial, {all}, order_number(number));
    const Traces in_several = run_in_processes(trial, groups, order_number(number));
    EXPECT_EQ(in_several.logs, in_one.logs) << "in order " << number;
    EXPECT_TRUE(in_several == in_one) << "in order " << number;
    if (number == 0) first = in_one;
  }
  return first;
}

Body send_numbers(const std::string& to, int count, Duration pace) {
  return [to, count, pace](Network& network, Log& log) {
    datagram_socket out(network);
    EXPECT_EQ(out.bind("out"), Status::ok);
    for (int i = 0; i < count; ++i) {
      note(log, out.send_to(to, bytes_of(long_text(60, static_cast<unsigned>(i)))));
      if (i % 7 == 0) note(log, out.send_to("ada:nobody", bytes_of("?")));
      if (pace > Duration()) sleep_for(std::chrono::nanoseconds(pace.ns()));
    }
  };
}

TEST(Processes, ExchangeDatagrams) {
  const Trial trial{varying,
                    {{"ada",
                      [](Network& network, Log& log) {
                        datagram_socket in(network, {.queue_max = 4});
                        EXPECT_EQ(in.bind("in"), Status::ok);
                        std::string text(100, '?');
                        const std::span<std::byte> room = std::as_writable_bytes(std::span(text));
                        for (Result<Datagram> got = in.receive(room, 20ms); got; got = in.receive(room, 20ms)) {
                          note(log, to_string(got->from) + " " + text.substr(0, got->size));
                          sleep_for(1ms);
                        }
                        note(log, std::to_string(in.dropped()) + " dropped");
                      }},
                     {"bob", send_numbers("ada:in", 40, Duration(1ms))},
                     {"eve", send_numbers("ada:in", 30, Duration())}}};
  const Traces traces = expect_equal_in_processes(trial, {{"bob"}, {"ada", "eve"}});
  EXPECT_EQ(traces, run_in_processes(trial, {{"ada"}, {"bob"}, {"eve"}}, order_number(0)));
  EXPECT_GT(traces.logs.at("ada").size(), 20u);
  EXPECT_GT(traces.statistics.lost, 0u);
  EXPECT_GT(traces.statistics.overflowed, 0u);
  EXPECT_GT(traces.statistics.unreachable, 0u);
}

TEST(Processes, ConnectStreams) {
  const auto serve = [](Network& network, Log& log) {
    stream_listener door(network, {.backlog = 1, .stream = {.buffer_bytes = 700}});
    EXPECT_EQ(door.listen("door"), Status::ok);
    Result<stream_socket> given_up = door.accept();
    note(log, read_text(*given_up));
    note(log, given_up->write(bytes_of("x")).status());
    Result<stream_socket> socket = door.accept();
    note(log, socket->peer_robot());
    note(log, read_all(*socket, 333));
    note(log, socket->write(bytes_of(long_text(5000))).status());
    socket->close();
    sleep_for(100ms);
  };
  const auto ask = [](Network& network, Log& log) {
    note(log, io::connect(network, "ada:window").status());
    note(log, io::connect(network, "ada:door", 500us).status());
    sleep_for(20ms);
    Result<stream_socket> socket = io::connect(network, "ada:door");
    note(log, socket->write(bytes_of(long_text(3000))).status());
    socket->shutdown_write();
    note(log, read_all(*socket, 100));
    note(log, socket->read({}).status());
    stream_socket waiting = std::move(*io::connect(network, "ada:door"));
    note(log, io::connect(network, "ada:door").status());
    note(log, read_text(waiting));
    note(log, waiting.write(bytes_of("x")).status());
  };
  const Traces traces = expect_equal_in_processes({varying, {{"ada", serve}, {"bob", ask}}}, {{"ada"}, {"bob"}});
  EXPECT_TRUE(has(traces.logs.at("ada"), long_text(3000)));
  EXPECT_TRUE(has(traces.logs.at("ada"), "peer closed")) << "of the client that gave up";
  EXPECT_TRUE(has(traces.logs.at("bob"), long_text(5000)));
  EXPECT_TRUE(has(traces.logs.at("bob"), "refused"));
  EXPECT_TRUE(has(traces.logs.at("bob"), "timed out"));
  EXPECT_TRUE(has(traces.logs.at("bob"), "[end of file]")) << "at the listener's close";
}

struct Errand {
  std::int32_t number = 0;
  Bounded<Point, 4> way;
  static void fields(auto field) {
    field("number", &Errand::number);
    field("way", &Errand::way);
  }
};

TEST(Processes, SendLettersAndReceipts) {
  const auto receive = [](Network& network, Log& log) {
    mailbox<Errand> box(2);
    EXPECT_EQ(box.bind(network, "errands"), Status::ok);
    for (int i = 0; i < 10; ++i) {
      const Result<Errand> errand = box.receive();
      note(log, std::to_string(errand.value().number) + " with " + std::to_string(errand.value().way.size()));
      sleep_for(2ms);
    }
    sleep_for(10ms);
    box.close();
    for (Result<Errand> errand = box.receive(); errand; errand = box.receive())
      note(log, std::to_string(errand->number));
    sleep_for(10ms);
  };
  const auto send = [](Network& network, Log& log) {
    mailbox_sender<Errand> errands(network, "ada:errands", 3), nobody(network, "ada:nobody");
    note(log, nobody.send({}));
    Errand errand;
    Status status = Status::ok;
    for (; status == Status::ok; ++errand.number) {
      if (errand.number < 4) errand.way.push_back({0.5 * errand.number, 1});
      note(log, status = errands.send(errand));
    }
    note(log, nobody.send({}));
  };
  const Traces traces = expect_equal_in_processes({varying, {{"ada", receive}, {"bob", send}}}, {{"ada"}, {"bob"}});
  EXPECT_TRUE(has(traces.logs.at("ada"), "9 with 4"));
  EXPECT_TRUE(has(traces.logs.at("ada"), "12")) << "received after the close";
  EXPECT_TRUE(has(traces.logs.at("bob"), "peer closed"));
  EXPECT_TRUE(has(traces.logs.at("bob"), "refused"));
}

TEST(Processes, KeepToTheRangeOfTheMedium) {
  Medium medium = varying;
  medium.range_m = 30;
  medium.range_check = Duration(3ms);
  // Out of range from 10 ms to 40 ms.
  const Trial trial{medium,
                    {{"ada",
                      [](Network& network, Log& log) {
                        mailbox<int> box(8);
                        EXPECT_EQ(box.bind(network, "in"), Status::ok);
                        datagram_socket socket(network);
                        EXPECT_EQ(socket.bind("in"), Status::ok);
                        for (Result<int> got = box.receive(50ms); got; got = box.receive(50ms)) {
                          note(log, std::to_string(*got));
                          while (socket.receive({}, no_wait)) note(log, "datagram");
                        }
                      }},
                     {"bob",
                      [](Network& network, Log& log) {
                        mailbox_sender<int> letters(network, "ada:in", 4);
                        datagram_socket socket(network);
                        for (int i = 0; i < 30; ++i, sleep_for(2ms)) {
                          note(log, letters.send(i));
                          note(log, socket.send_to("ada:in", {}));
                        }
                      }}},
                    [](Time time) { return time > at(10ms) && time < at(40ms) ? 31.0 : 20.0; }};
  const Traces traces = expect_equal_in_processes(trial, {{"ada"}, {"bob"}});
  EXPECT_TRUE(has(traces.logs.at("ada"), "29"));
  EXPECT_GT(traces.statistics.out_of_range, 0u);
}

}  // namespace
}  // namespace waitpoint::io
