// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/io/pipe.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "core/random.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/io/bytes.hpp"
#include "tests/fibers/sync/orders.hpp"

namespace waitpoint::io {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;

TEST(Pipe, GivesBytesInTheOrderInWhichTheyWereWritten) {
  in_every_order([] {
    auto [reader, writer] = make_pipe(10);
    EXPECT_EQ(writer.write(bytes_of("abcdef")).value(), 6u);
    EXPECT_EQ(read_text(reader, 4), "abcd");
    EXPECT_EQ(writer.write(bytes_of("ghijklm")).value(), 7u) << "around the end of the ring";
    EXPECT_EQ(read_text(reader, 100), "efghijklm");
    EXPECT_EQ(read_text(reader, 0), "") << "nothing asked, nothing waited for";
    EXPECT_EQ(now(), Time());
  });
}

TEST(Pipe, AWriterOfMuchWaitsForReadersAndLosesNothing) {
  in_every_order([] {
    auto [reader, writer] = make_pipe(64);
    const std::string text = long_text(5000);
    thread other(
        [&text, writer = std::move(writer)]() mutable { EXPECT_EQ(writer.write(bytes_of(text)).value(), 5000u); });
    writer = pipe_writer();
    sleep_for(1ms);
    EXPECT_EQ(read_all(reader), text);
    other.join();
  });
}

TEST(Pipe, AReaderWaitsForAWriter) {
  in_every_order([] {
    PipeEnds pipe = make_pipe();
    pipe_reader& reader = pipe.reader;
    pipe_writer& writer = pipe.writer;
    thread other([&] {
      EXPECT_EQ(read_text(reader), "late");
      EXPECT_EQ(now(), at(3ms));
    });
    sleep_for(3ms);
    EXPECT_TRUE(writer.write(bytes_of("late")));
    other.join();
  });
}

TEST(Pipe, WithoutWaitingSaysWhatWouldBlockAndDoesTheRest) {
  in_order([] {
    auto [reader, writer] = make_pipe(5000);
    EXPECT_EQ(read_text(reader, 10, no_wait), "[would block]");
    const Result<std::size_t> much = writer.write(bytes_of(long_text(6000)), no_wait);
    EXPECT_EQ(much.status(), Status::would_block);
    EXPECT_EQ(much.value(), 5000u);
    EXPECT_EQ(read_text(reader, 10, no_wait).size(), 10u);
    const Result<std::size_t> little = writer.write(bytes_of("eleven byte"), no_wait);
    EXPECT_EQ(little.status(), Status::would_block);
    EXPECT_EQ(little.value(), 0u) << "a short write is made as a whole or not at all";
    EXPECT_TRUE(writer.write(bytes_of("ten bytes!"), no_wait));
    EXPECT_EQ(now(), Time());
  });
}

TEST(Pipe, TimesOutAtTheDeadline) {
  in_every_order([] {
    auto [reader, writer] = make_pipe(4);
    EXPECT_EQ(read_text(reader, 10, 5ms), "[timed out]");
    EXPECT_EQ(now(), at(5ms));
    EXPECT_EQ(read_text(reader, 10, 0ms), "[timed out]");
    EXPECT_EQ(read_text(reader, 10, -1h), "[timed out]");
    EXPECT_EQ(read_text(reader, 10, at(7ms)), "[timed out]");
    EXPECT_EQ(now(), at(7ms));
    const Result<std::size_t> much = writer.write(bytes_of("abcdefgh"), 3ms);
    EXPECT_EQ(much.status(), Status::timed_out);
    EXPECT_EQ(much.value(), 4u);
    EXPECT_EQ(now(), at(10ms));
    thread other([writer = writer]() mutable {
      sleep_for(1ms);
      EXPECT_TRUE(writer.write(bytes_of("e"), std::chrono::hours::max()));
    });
    EXPECT_EQ(read_text(reader, 10, 5ms), "abcd");
    EXPECT_EQ(read_text(reader, 10, 5ms), "e") << "in time";
    EXPECT_EQ(now(), at(11ms));
    other.join();
  });
}

TEST(Pipe, WrittenAtTheInstantOfTheDeadlineNothingIsLost) {
  expect_both([] {
    PipeEnds pipe = make_pipe();
    pipe_reader& reader = pipe.reader;
    pipe_writer& writer = pipe.writer;
    std::string text;
    thread other([&] { text = read_text(reader, 10, 5ms); });
    sleep_for(5ms);
    EXPECT_TRUE(writer.write(bytes_of("x")));
    other.join();
    EXPECT_EQ(now(), at(5ms));
    if (text != "x") {
      EXPECT_EQ(text, "[timed out]");
      EXPECT_EQ(read_text(reader, 10, no_wait), "x");
    }
    return text == "x";
  });
}

TEST(Pipe, EndsWhenTheLastCopyOfItsWriterIsClosed) {
  in_every_order([] {
    PipeEnds pipe = make_pipe();
    pipe_reader& reader = pipe.reader;
    pipe_writer& writer = pipe.writer;
    std::optional<pipe_writer> second = writer;
    EXPECT_TRUE(writer.write(bytes_of("rest")));
    writer.close();
    EXPECT_FALSE(writer.is_open());
    thread other([&] {
      EXPECT_EQ(read_all(reader), "rest");
      EXPECT_EQ(now(), at(2ms));
      EXPECT_EQ(read_text(reader), "[end of file]") << "again";
    });
    sleep_for(2ms);
    second.reset();
    other.join();
  });
}

TEST(Pipe, WriteWithoutAReaderReportsIt) {
  in_every_order([] {
    auto [reader, writer] = make_pipe(8);
    thread other([writer = writer]() mutable {
      const Result<std::size_t> cut = writer.write(bytes_of(long_text(5000)));
      EXPECT_EQ(cut.status(), Status::peer_closed);
      EXPECT_EQ(cut.value(), 8u);
      EXPECT_EQ(now(), at(1ms));
    });
    sleep_for(1ms);
    reader.close();
    other.join();
    EXPECT_EQ(writer.write(bytes_of("x")).status(), Status::peer_closed);
  });
}

TEST(Pipe, ShortWritesOfManyAreNotMixed) {
  in_every_order([] {
    auto [reader, writer] = make_pipe(100);
    std::vector<thread> threads;
    for (const char name : {'a', 'b', 'c'})
      threads.emplace_back([name, writer = writer]() mutable {
        for (int i = 0; i < 20; ++i) EXPECT_TRUE(writer.write(bytes_of(std::string(30, name))));
      });
    writer.close();
    const std::string all = read_all(reader, 13);
    for (thread& t : threads) t.join();
    ASSERT_EQ(all.size(), 1800u);
    for (std::size_t i = 0; i < all.size(); i += 30) EXPECT_EQ(all.substr(i, 30), std::string(30, all[i]));
  });
}

TEST(Pipe, AWriterOfLittleIsNotHeldUpByOneOfMuch) {
  in_every_order([] {
    auto [reader, writer] = make_pipe(10);
    EXPECT_TRUE(writer.write(bytes_of("12345678")));
    thread much([writer = writer]() mutable { EXPECT_TRUE(writer.write(bytes_of("ABCDEFGH"))); });
    sleep_for(1ms);
    thread little([writer = writer]() mutable { EXPECT_TRUE(writer.write(bytes_of("abcd"))); });
    sleep_for(1ms);
    EXPECT_EQ(read_text(reader, 2), "12");
    sleep_for(1ms);
    EXPECT_EQ(read_text(reader, 10), "345678abcd");
    EXPECT_EQ(read_text(reader, 10), "ABCDEFGH");
    much.join();
    little.join();
  });
}

TEST(Pipe, BytesWrittenAreInTheDigest) {
  const auto digest = [](const char* text) {
    return to_string(in_order([=] {
                       auto [reader, writer] = make_pipe();
                       EXPECT_TRUE(writer.write(bytes_of(text)));
                     }).digest);
  };
  EXPECT_EQ(digest("abc"), digest("abc"));
  EXPECT_NE(digest("abc"), digest("abd"));
}

TEST(Pipe, IsFreshInTheNextRun) {
  std::optional<PipeEnds> pipe;
  in_order([&] {
    pipe = make_pipe();
    EXPECT_TRUE(pipe->writer.write(bytes_of("left behind")));
  });
  in_order([&] { EXPECT_EQ(read_text(pipe->reader, 20, no_wait), "[would block]"); });
}

TEST(PipeDeathTest, MisuseIsABug) {
  EXPECT_DEATH(simulate([] {
                 auto [reader, writer] = make_pipe();
                 reader.close();
                 (void)read_text(reader);
               }),
               "an end of a pipe is used after its close");
  EXPECT_DEATH(simulate([] {
                 auto [reader, writer] = make_pipe();
                 writer.close();
                 writer.close();
               }),
               "an end of a pipe is used after its close");
  EXPECT_DEATH((void)make_pipe(0), "at least one byte and at most 64 MiB");
  EXPECT_DEATH((void)make_pipe(std::size_t{1} << 40), "at least one byte and at most 64 MiB");
  EXPECT_DEATH((void)make_pipe().writer.write({}), "a simulated primitive is used outside a simulated task");
  EXPECT_DEATH(
      {
        Simulation simulation;
        auto pipe = make_pipe();
        simulation.spawn(simulation.add_robot("ada"), {}, [&] { (void)pipe.writer.write(bytes_of("x")); });
        simulation.spawn(simulation.add_robot("bob"), {}, [&] { (void)read_text(pipe.reader); });
        simulation.run_before();
      },
      "used by a task of another robot");
}

}  // namespace
}  // namespace waitpoint::io
