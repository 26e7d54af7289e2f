// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/io/poll.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/random.hpp"
#include "fibers/io/mailbox.hpp"
#include "fibers/io/pipe.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/io/bytes.hpp"
#include "tests/fibers/sync/orders.hpp"

namespace waitpoint::io {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;

TEST(Poll, TellsWhatIsReadyAndTellsItAgain) {
  in_every_order([] {
    auto [reader, writer] = make_pipe(4);
    mailbox<int> numbers(1);
    PollEntry entries[] = {
        {reader, Events::readable}, {writer, Events::writable}, {numbers, Events::readable | Events::writable}};
    EXPECT_EQ(poll(entries).value(), 2u);
    EXPECT_EQ(entries[0].ready, Events::none);
    EXPECT_EQ(entries[1].ready, Events::writable);
    EXPECT_EQ(entries[2].ready, Events::writable);
    EXPECT_TRUE(writer.write(bytes_of("full")));
    EXPECT_EQ(numbers.send(3), Status::ok);
    for (int again = 0; again < 2; ++again) {
      EXPECT_EQ(poll(entries, no_wait).value(), 2u);
      EXPECT_EQ(entries[0].ready, Events::readable);
      EXPECT_EQ(entries[1].ready, Events::none);
      EXPECT_EQ(entries[2].ready, Events::readable);
    }
    EXPECT_EQ(now(), Time());
  });
}

TEST(Poll, WaitsForTheFirstOfMany) {
  in_every_order([] {
    std::vector<PipeEnds> pipes;
    std::vector<PollEntry> entries;
    for (int i = 0; i < 50; ++i) {
      pipes.push_back(make_pipe());
      entries.push_back({pipes.back().reader, Events::readable});
    }
    std::vector<thread> threads;
    for (std::size_t i = 0; i < pipes.size(); ++i)
      threads.emplace_back([&, i] {
        sleep_for(std::chrono::milliseconds(1 + i * 7 % 50));
        EXPECT_TRUE(pipes[i].writer.write(bytes_of("x")));
      });
    for (std::int64_t turn = 1; turn <= 50; ++turn) {
      ASSERT_EQ(poll(entries).value(), 1u);
      EXPECT_EQ(now(), at(turn * Duration(1ms)));
      for (std::size_t i = 0; i < pipes.size(); ++i)
        if (any(entries[i].ready)) {
          EXPECT_EQ(1 + i * 7 % 50, static_cast<std::size_t>(turn));
          EXPECT_EQ(read_text(pipes[i].reader, 1, no_wait), "x");
        }
    }
    for (thread& t : threads) t.join();
    EXPECT_EQ(poll(entries, no_wait).status(), Status::would_block);
  });
}

TEST(Poll, TimesOutAtTheDeadline) {
  in_every_order([] {
    auto [reader, writer] = make_pipe();
    PollEntry entries[] = {{reader, Events::readable}};
    EXPECT_EQ(poll(entries, no_wait).status(), Status::would_block);
    EXPECT_EQ(poll(entries, 0ms).status(), Status::timed_out);
    EXPECT_EQ(poll({}, 5ms).status(), Status::timed_out) << "nothing to wait for is a sleep";
    EXPECT_EQ(poll(entries, 5ms).status(), Status::timed_out);
    EXPECT_EQ(now(), at(10ms));
    EXPECT_EQ(entries[0].ready, Events::none);
  });
}

TEST(Poll, ReadyAtTheInstantOfTheDeadlineIsToldByThisPollOrTheNext) {
  expect_both([] {
    mailbox<int> box(1);
    PollEntry entries[] = {{box, Events::readable}};
    Status status = Status::ok;
    thread other([&] { status = poll(entries, 5ms).status(); });
    sleep_for(5ms);
    EXPECT_EQ(box.send(1), Status::ok);
    other.join();
    EXPECT_EQ(poll(entries, no_wait).value(), 1u);
    return status == Status::ok;
  });
}

TEST(Poll, WakesAllPollersAndOneTakesTheMessage) {
  in_every_order([] {
    mailbox<int> box(4);
    int told = 0, got = 0;
    std::vector<thread> threads;
    for (int i = 0; i < 5; ++i)
      threads.emplace_back([&] {
        PollEntry entries[] = {{box, Events::readable}};
        const Result<std::size_t> ready = poll(entries, 5ms);
        // Tasks that are woken after the first has taken the letter keep waiting.
        if (!ready) return;
        ++told;
        got += box.try_receive() ? 1 : 0;
      });
    sleep_for(1ms);
    EXPECT_EQ(box.send(1), Status::ok);
    for (thread& t : threads) t.join();
    EXPECT_GE(told, 1);
    EXPECT_EQ(got, 1);
    EXPECT_EQ(now(), at(5ms));
  });
}

TEST(Poll, APollerAndAReceiverAreBothWoken) {
  in_every_order([] {
    mailbox<int> box(4);
    int received = 0;
    thread receiver([&] { received = *box.receive(); });
    thread poller([&] {
      PollEntry entries[] = {{box, Events::readable}};
      for (;;) {
        if (!poll(entries, 2ms)) break;
        if (const auto number = box.try_receive()) received = number.value();
      }
    });
    sleep_for(1ms);
    EXPECT_EQ(box.send(7), Status::ok);
    sleep_for(5ms);
    EXPECT_EQ(received, 7);
    EXPECT_EQ(box.send(8), Status::ok);
    receiver.join();
    poller.join();
    EXPECT_TRUE(received == 7 || received == 8);
  });
}

TEST(Poll, TellsWhatIsClosedMeanwhile) {
  in_every_order([] {
    PipeEnds pipe = make_pipe();
    mailbox<int> box(1);
    PollEntry entries[] = {{pipe.reader, Events::readable}, {box, Events::readable}};
    thread other([&] {
      sleep_for(1ms);
      pipe.reader.close();
      sleep_for(1ms);
      box.close();
    });
    EXPECT_EQ(poll(entries).value(), 1u);
    EXPECT_EQ(now(), at(1ms));
    EXPECT_EQ(entries[0].ready, Events::closed) << "the end that is polled";
    entries[0].source = box;
    EXPECT_EQ(poll(entries, 5ms).value(), 2u);
    EXPECT_EQ(now(), at(2ms));
    EXPECT_EQ(entries[1].ready, Events::readable | Events::closed) << "end of file can be received";
    other.join();
  });
}

TEST(Poll, EndOfFileAndABrokenPipeDoNotBlockAndSoAreReady) {
  in_order([] {
    PipeEnds a = make_pipe(), b = make_pipe(1);
    EXPECT_TRUE(b.writer.write(bytes_of("x")));
    PollEntry entries[] = {{a.reader, Events::readable}, {b.writer, Events::writable}};
    a.writer.close();
    b.reader.close();
    EXPECT_EQ(poll(entries).value(), 2u);
    EXPECT_EQ(entries[0].ready, Events::readable | Events::closed);
    EXPECT_EQ(entries[1].ready, Events::writable | Events::closed);
  });
}

TEST(Select, LeavesWhatIsReadyInItsLists) {
  in_every_order([] {
    PipeEnds a = make_pipe(1), b = make_pipe(1);
    thread other([&] {
      sleep_for(1ms);
      EXPECT_TRUE(b.writer.write(bytes_of("x")));
    });
    std::vector<Source> readable = {a.reader, b.reader}, writable;
    EXPECT_EQ(select(readable, writable).value(), 1u);
    EXPECT_EQ(readable, std::vector<Source>{b.reader});
    EXPECT_EQ(now(), at(1ms));
    readable = {a.reader};
    writable = {a.writer, b.writer};
    EXPECT_EQ(select(readable, writable, 5ms).value(), 1u);
    EXPECT_TRUE(readable.empty());
    EXPECT_EQ(writable, std::vector<Source>{a.writer});
    readable = {a.reader};
    writable = {b.writer};
    EXPECT_EQ(select(readable, writable, 5ms).status(), Status::timed_out);
    EXPECT_TRUE(readable.empty() && writable.empty());
    other.join();
  });
}

TEST(Poll, AChannelForgetsAPollerThatIsUnwound) {
  PipeEnds pipe = make_pipe();
  {
    Simulation simulation;
    simulation.spawn(simulation.environment(), {}, [&] {
      PollEntry entries[] = {{pipe.reader, Events::readable}};
      (void)poll(entries);
    });
    simulation.spawn(simulation.environment(), {}, [] { sleep_for(1h); });
    EXPECT_EQ(simulation.run_before(at(1ms)), RunEnd::time_reached);
  }
  in_order([&] { EXPECT_TRUE(pipe.writer.write(bytes_of("x"))); });
}

}  // namespace
}  // namespace waitpoint::io
