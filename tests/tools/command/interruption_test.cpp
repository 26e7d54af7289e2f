// SPDX-License-Identifier: BSD-3-Clause
// The handling of a user's signals.
#include "tools/command/interruption.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

namespace waitpoint::tools {
namespace {

/// Exits with status 0 if the signal was noted.
[[noreturn]] void end() { std::_Exit(interruption() == SIGINT ? 0 : 1); }

TEST(Interruption, TheFirstSignalIsNoted) {
  EXPECT_EXIT((heed_signals(), std::raise(SIGINT), end()), testing::ExitedWithCode(0), "");
}

TEST(Interruption, AnEchoOfTheSameMomentIsNotASecondSignal) {
  EXPECT_EXIT((heed_signals(), std::raise(SIGINT), std::raise(SIGINT), std::raise(SIGTERM), end()),
              testing::ExitedWithCode(0), "");
}

TEST(Interruption, ASecondSignalEndsTheProcess) {
  const auto impatient = [] {
    heed_signals();
    std::raise(SIGINT);
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    std::raise(SIGTERM);
    end();
  };
  EXPECT_EXIT(impatient(), testing::KilledBySignal(SIGTERM), "");
}

TEST(Interruption, NextSignalAfterForgettingIsTheFirst) {
  const auto forgetful = [] {
    heed_signals();
    std::raise(SIGINT);
    forget_interruption();
    if (interruption() != 0) std::_Exit(1);
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    std::raise(SIGINT);
    end();
  };
  EXPECT_EXIT(forgetful(), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace waitpoint::tools
