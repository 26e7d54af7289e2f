// SPDX-License-Identifier: BSD-3-Clause
// Waits to send or to accept that are satisfied at the very instant of the deadline: in time in some orders, timed out
// in others; a message is delivered exactly once if sent, and not at all otherwise. (Waits to receive: the tests of
// each kind.)
#include <gtest/gtest.h>

#include <functional>

#include "fibers/io/mailbox_sender.hpp"
#include "fibers/io/pipe.hpp"
#include "fibers/io/stream_listener.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/io/bytes.hpp"
#include "tests/fibers/io/fleet.hpp"

namespace waitpoint::io {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;

// `wait` in a task, `let` at 5 ms; the status of `wait`.
Status at_one_instant(const std::function<Status()>& wait, const std::function<void()>& let) {
  Status status = Status::ok;
  thread waiting([&] {
    status = wait();
    EXPECT_EQ(now(), at(5ms));
  });
  sleep_for(5ms);
  let();
  waiting.join();
  EXPECT_TRUE(status == Status::ok || status == Status::timed_out) << to_string(status);
  return status;
}

TEST(RoomAtTheDeadline, Pipe) {
  expect_both([] {
    PipeEnds pipe = make_pipe(4);
    EXPECT_TRUE(pipe.writer.write(bytes_of("full")));
    const Status status = at_one_instant([&] { return pipe.writer.write(bytes_of("more"), 5ms).status(); },
                                         [&] { EXPECT_EQ(read_text(pipe.reader), "full"); });
    EXPECT_EQ(read_text(pipe.reader, 9, no_wait), status == Status::ok ? "more" : "[would block]");
    return status == Status::ok;
  });
}

TEST(RoomAtTheDeadline, Mailbox) {
  expect_both([] {
    mailbox<int> box(1);
    EXPECT_EQ(box.send(1), Status::ok);
    const Status status =
        at_one_instant([&] { return box.send_for(2, 5ms); }, [&] { EXPECT_EQ(*box.try_receive(), 1); });
    EXPECT_EQ(static_cast<bool>(box.try_receive()), status == Status::ok);
    return status == Status::ok;
  });
}

TEST(RoomAtTheDeadline, MailboxWindow) {
  expect_both([] {
    Network network;
    mailbox<int> box(1);
    EXPECT_EQ(box.bind(network, "in"), Status::ok);
    mailbox_sender<int> sender(network, "in", 1);
    EXPECT_EQ(sender.send(1), Status::ok);
    const Status status =
        at_one_instant([&] { return sender.send_for(2, 5ms); }, [&] { EXPECT_EQ(*box.try_receive(), 1); });
    EXPECT_EQ(static_cast<bool>(box.try_receive()), status == Status::ok);
    return status == Status::ok;
  });
}

TEST(RoomAtTheDeadline, Stream) {
  expect_both([] {
    Network network;
    stream_listener door(network, {.stream = {.buffer_bytes = 4}});
    EXPECT_EQ(door.listen("door"), Status::ok);
    Result<stream_socket> out = connect(network, "door"), in = door.accept();
    EXPECT_TRUE(out->write(bytes_of("full")));
    const Status status = at_one_instant([&] { return out->write(bytes_of("more"), 5ms).status(); },
                                         [&] { EXPECT_EQ(read_text(*in), "full"); });
    EXPECT_EQ(read_text(*in, 9, no_wait), status == Status::ok ? "more" : "[would block]");
    return status == Status::ok;
  });
}

TEST(RoomAtTheDeadline, AConnectionToAccept) {
  expect_both([] {
    Network network;
    stream_listener door(network);
    EXPECT_EQ(door.listen("door"), Status::ok);
    stream_socket client;
    const Status status = at_one_instant([&] { return door.accept(5ms).status(); },
                                         [&] { client = std::move(*connect(network, "door")); });
    EXPECT_EQ(door.accept(no_wait).status(), status == Status::ok ? Status::would_block : Status::ok);
    return status == Status::ok;
  });
}

// Arrivals from another robot precede the tasks of their instant: always in time.
TEST(RoomAtTheDeadline, WordFromAnotherRobotIsInTime) {
  in_every_order({"ada", "bob"}, two_ms, [](Fleet& fleet) {
    fleet.spawn("ada", [&] {
      mailbox<int> box(4);
      EXPECT_EQ(box.bind(fleet.network, "in"), Status::ok);
      EXPECT_EQ(*box.receive(), 1);
      EXPECT_EQ(*box.receive(), 2);
    });
    fleet.spawn("bob", [&] {
      sleep_for(1ms);
      mailbox_sender<int> sender(fleet.network, "ada:in", 1);
      EXPECT_EQ(sender.send(1), Status::ok);
      EXPECT_EQ(sender.send_for(2, 4ms), Status::ok);
      EXPECT_EQ(now(), at(5ms));
    });
  });
}

}  // namespace
}  // namespace waitpoint::io
