// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/laas/include/posterLib.h"

#include <array>
#include <cstring>

#include "fibers/laas/include/smMemLib.h"
#include "tests/fibers/laas/pocolibs/pocolibs_run.hpp"

namespace waitpoint {
namespace {

POSTER_ID create(const char* name, int size) {
  POSTER_ID poster = nullptr;
  EXPECT_EQ(posterCreate(name, size, &poster), OK) << error_name();
  return poster;
}

TEST(PosterLib, AReaderSeesWhatTheWriterWrote) {
  with_clock([] {
    const POSTER_ID written = create("position", 8);
    POSTER_ID found = nullptr;
    ASSERT_EQ(posterFind("position", &found), OK);
    EXPECT_STREQ(posterName(found), "position");
    std::array<char, 8> text{"abcdefg"}, read{};
    EXPECT_EQ(posterWrite(written, 0, text.data(), 8), 8);
    EXPECT_EQ(posterRead(found, 0, read.data(), 8), 8);
    EXPECT_EQ(read, text);
    // From an offset, up to the end.
    EXPECT_EQ(posterRead(found, 5, read.data(), 8), 3);
    EXPECT_STREQ(read.data(), "fg");
    char mark = 'X';
    EXPECT_EQ(posterWrite(written, 7, &mark, 4), 1);
  });
}

TEST(PosterLib, NothingIsReadBeforeTheFirstWrite) {
  with_clock([] {
    const POSTER_ID poster = create("empty", 4);
    int value = 7, fresh = 7;
    EXPECT_EQ(posterRead(poster, 0, &value, 4), ERROR);
    EXPECT_EQ(error_name(), "S_posterLib_EMPTY_POSTER");
    EXPECT_EQ(posterTake(poster, POSTER_READ), ERROR);
    EXPECT_EQ(posterIoctl(poster, FIO_FRESH, &fresh), OK);
    EXPECT_EQ(fresh, FALSE);
    H2TIME date;
    EXPECT_EQ(posterIoctl(poster, FIO_GETDATE, &date), ERROR);
    unsigned long age_ms = 0;
    EXPECT_EQ(posterIoctl(poster, FIO_NMSEC, &age_ms), ERROR);
    posterWrite(poster, 0, &value, 4);
    EXPECT_EQ(posterIoctl(poster, FIO_FRESH, &fresh), OK);
    EXPECT_EQ(fresh, TRUE);
  });
}

// The date is that of the end of the write, not of its beginning.
TEST(PosterLib, APosterIsDatedWhenItIsGiven) {
  with_clock([] {
    const POSTER_ID poster = create("slow", 4);
    sleep_until_tick(10);
    ASSERT_EQ(posterTake(poster, POSTER_WRITE), OK);
    std::memset(posterAddr(poster), 1, 4);
    sleep_until_tick(13);
    ASSERT_EQ(posterGive(poster), OK);
    sleep_until_tick(20);
    unsigned long age_ms = 0;
    H2TIME date;
    EXPECT_EQ(posterIoctl(poster, FIO_NMSEC, &age_ms), OK);
    EXPECT_EQ(age_ms, 70u);
    EXPECT_EQ(posterIoctl(poster, FIO_GETDATE, &date), OK);
    EXPECT_EQ(date.ntick, 13u);
    EXPECT_EQ(date.msec, 130);
    EXPECT_EQ(date.year, 100);
    int value = 0;
    EXPECT_EQ(posterRead(poster, 0, &value, 4), 4);
    EXPECT_EQ(value, 0x01010101);
  });
}

TEST(PosterLib, ATakenPosterIsUsedByOneTaskAtATime) {
  with_clock([] {
    const POSTER_ID poster = create("pair", 8);
    std::array<int, 2> pair{0, 0};
    posterWrite(poster, 0, pair.data(), 8);
    thread writer = start_task("writer", [poster] {
      for (int i = 1; i <= 5; ++i) {
        posterTake(poster, POSTER_WRITE);
        int* const values = static_cast<int*>(posterAddr(poster));
        values[0] = i;
        taskDelay(1);
        values[1] = i;
        posterGive(poster);
        taskDelay(1);
      }
    });
    for (int i = 0; i < 20; ++i) {
      EXPECT_EQ(posterRead(poster, 0, pair.data(), 8), 8);
      EXPECT_EQ(pair[0], pair[1]);
      this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    writer.join();
  });
}

TEST(PosterLib, AccessesAreCountedAndCleared) {
  with_clock([] {
    const POSTER_ID poster = create("counted", 16);
    std::array<char, 16> bytes{};
    posterWrite(poster, 0, bytes.data(), 16);
    posterRead(poster, 0, bytes.data(), 10);
    posterRead(poster, 0, bytes.data(), 5);
    H2_POSTER_STAT_STR accesses{};
    EXPECT_EQ(posterIoctl(poster, FIO_GETSTATS, &accesses), OK);
    EXPECT_EQ(accesses.write_ops, 1u);
    EXPECT_EQ(accesses.write_bytes, 16u);
    EXPECT_EQ(accesses.read_ops, 2u);
    EXPECT_EQ(accesses.read_bytes, 15u);
    posterIoctl(poster, FIO_GETSTATS, &accesses);
    EXPECT_EQ(accesses.write_ops + accesses.read_ops, 0u);
  });
}

TEST(PosterLib, AResizedPosterIsEmptyAndKeepsItsBytes) {
  with_clock([] {
    const POSTER_ID poster = create("growing", 4);
    int value = 42;
    posterWrite(poster, 0, &value, 4);
    std::size_t size = 400;
    EXPECT_EQ(posterIoctl(poster, FIO_RESIZE, &size), OK);
    size = 0;
    EXPECT_EQ(posterIoctl(poster, FIO_GETSIZE, &size), OK);
    EXPECT_EQ(size, 400u);
    EXPECT_EQ(posterRead(poster, 0, &value, 4), ERROR);
    EXPECT_EQ(*static_cast<int*>(posterAddr(poster)), 42);
    size = SM_MEM_SIZE + 1;
    EXPECT_EQ(posterIoctl(poster, FIO_RESIZE, &size), ERROR);
    EXPECT_EQ(error_name(), "S_posterLib_MALLOC_ERROR");
  });
}

TEST(PosterLib, MistakesAreErrorsThatLeaveThePosterUsable) {
  with_clock([] {
    const POSTER_ID poster = create("position", 4);
    int value = 1;
    POSTER_ID other = nullptr;
    EXPECT_EQ(posterCreate("position", 4, &other), ERROR);
    EXPECT_EQ(error_name(), "S_h2devLib_DUPLICATE_DEVICE_NAME");
    EXPECT_EQ(posterFind("nowhere", &other), ERROR);
    EXPECT_EQ(error_name(), "S_h2devLib_NOT_FOUND");
    EXPECT_EQ(posterCreate("more than the shared memory", SM_MEM_SIZE + 1, &other), ERROR);
    EXPECT_EQ(error_name(), "S_posterLib_MALLOC_ERROR");
    EXPECT_EQ(posterMemCreate("bus", POSTER_VME_A24, nullptr, 4, &other), ERROR);
    EXPECT_EQ(posterTake(poster, static_cast<POSTER_OP>(9)), ERROR);
    EXPECT_EQ(error_name(), "S_posterLib_BAD_OP");
    EXPECT_EQ(posterIoctl(poster, 99, &value), ERROR);
    EXPECT_EQ(error_name(), "S_posterLib_BAD_IOCTL_CODE");
    for (const int offset : {4, -1}) {
      EXPECT_EQ(posterWrite(poster, offset, &value, 4), 0);
      EXPECT_EQ(error_name(), "S_posterLib_BAD_FORMAT");
      EXPECT_EQ(posterRead(poster, offset, &value, 4), 0);
    }
    EXPECT_EQ(posterWrite(poster, 0, &value, 4), 4);
    EXPECT_EQ(posterRead(poster, 0, &value, 4), 4);
  });
}

TEST(PosterLib, ADeletedPosterIsClosedAlsoForWaitingTasks) {
  with_clock([] {
    const POSTER_ID poster = create("position", 4);
    int value = 1;
    posterTake(poster, POSTER_WRITE);
    thread waiting = start_task("waiting", [poster, &value] {
      EXPECT_EQ(posterWrite(poster, 0, &value, 4), ERROR);
      EXPECT_EQ(error_name(), "S_posterLib_POSTER_CLOSED");
    });
    taskDelay(1);
    EXPECT_EQ(posterDelete(poster), OK);
    waiting.join();
    EXPECT_EQ(posterRead(poster, 0, &value, 4), ERROR);
    EXPECT_EQ(error_name(), "S_posterLib_POSTER_CLOSED");
    EXPECT_EQ(posterAddr(poster), nullptr);
    EXPECT_EQ(posterDelete(poster), ERROR);
    EXPECT_EQ(posterForget(poster), ERROR);
    // The name is free; the old id stays closed.
    EXPECT_NE(create("position", 4), poster);
    EXPECT_EQ(posterGive(poster), ERROR);
  });
}

TEST(PosterLib, BytesHaveTheOrderThatWasSet) {
  with_clock([] {
    const POSTER_ID poster = create("remote", 4);
    H2_ENDIANNESS order = H2_BIG_ENDIAN;
    EXPECT_EQ(posterEndianness(poster, &order), OK);
    EXPECT_EQ(order, H2_LOCAL_ENDIANNESS);
    EXPECT_EQ(posterSetEndianness(poster, H2_BIG_ENDIAN), OK);
    EXPECT_EQ(posterEndianness(poster, &order), OK);
    EXPECT_EQ(order, H2_BIG_ENDIAN);
  });
}

TEST(PosterLib, TablesNameThePosters) {
  testing::internal::CaptureStderr();
  in_order([] {
    h2initGlob(100);
    const POSTER_ID poster = create("position", 4);
    create("empty", 12);
    int value = 1;
    posterWrite(poster, 0, &value, 4);
    EXPECT_EQ(posterShow(), OK);
    EXPECT_EQ(posterStats(), OK);
  });
  const std::string tables = testing::internal::GetCapturedStderr();
  EXPECT_NE(tables.find("position                                1        4 00h:00min00s 0\n"), tables.npos) << tables;
  EXPECT_NE(tables.find("empty                                   2       12 EMPTY_POSTER!\n"), tables.npos) << tables;
  EXPECT_NE(tables.find("position                                  0          1          0          4\n"), tables.npos)
      << tables;
}

}  // namespace
}  // namespace waitpoint
