// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/laas/include/h2errorLib.h"

#include <array>
#include <cerrno>

#include "fibers/laas/include/csLib.h"
#include "tests/fibers/laas/pocolibs/pocolibs_run.hpp"

namespace waitpoint {
namespace {

constexpr H2_ERROR arm_errors[] = {{"TOO_FAR", 1}, {"BROKEN", 2}};
// A standard error of module 100, as other modules return it.
constexpr H2_ERROR standard_errors[] = {{"BAD_PARAMETER", H2_ENCODE_STD_ERR(100, 3)}};

std::string name(int code) {
  std::array<char, 64> text{};
  return h2getErrMsg(code, text.data(), static_cast<int>(text.size()));
}

TEST(H2errorLib, CodesHaveTheNamesThatWereRecorded) {
  with_clock([] {
    EXPECT_EQ(name(H2_ENCODE_ERR(700, 2)), "S_700_2");
    EXPECT_EQ(h2recordErrMsgs("test", "arm", 700, 2, arm_errors), 1);
    EXPECT_EQ(name(H2_ENCODE_ERR(700, 2)), "S_arm_BROKEN");
    EXPECT_EQ(name(H2_ENCODE_ERR(700, 9)), "S_arm_9");
    EXPECT_EQ(name(S_csLib_BAD_RQST_ID), "S_csLib_BAD_RQST_ID");
    EXPECT_EQ(name(0), "Unknown error");
    EXPECT_EQ(name(EINVAL), "Invalid argument");
  });
}

TEST(H2errorLib, StandardErrorsNameBothModules) {
  with_clock([] {
    const int code = H2_ENCODE_ERR(700, H2_ENCODE_STD_ERR(100, 3));
    EXPECT_EQ(name(code), "S_700_std100_3");
    h2recordErrMsgs("test", "arm", 700, 2, arm_errors);
    EXPECT_EQ(name(code), "S_arm_std100_3");
    h2recordErrMsgs("test", "std", 100, 1, standard_errors);
    EXPECT_EQ(name(code), "S_arm_std_BAD_PARAMETER");
    short number = 0, module = 0, standard = 0;
    EXPECT_EQ(h2decodeError(code, &number, &module, &standard), 700);
    EXPECT_TRUE(H2_TEST_STD_ERR(number));
    EXPECT_EQ(module, 100);
    EXPECT_EQ(standard, 3);
    EXPECT_EQ(h2decodeError(S_csLib_BAD_RQST_ID, &number, &module, &standard), 512);
    EXPECT_EQ(number, 3);
    EXPECT_EQ(module, 0);
  });
}

TEST(H2errorLib, ANumberKeepsItsFirstOwner) {
  testing::internal::CaptureStdout();
  in_order([] {
    h2recordErrMsgs("first", "arm", 700, 2, arm_errors);
    h2recordErrMsgs("again", "arm", 700, 2, arm_errors);
    h2recordErrMsgs("second", "leg", 700, 2, arm_errors);
    EXPECT_EQ(name(H2_ENCODE_ERR(700, 1)), "S_arm_TOO_FAR");
  });
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "h2recordErrMsgs by second: number 700 of leg is taken by arm\n");
}

TEST(H2errorLib, EachTaskHasItsErrorCode) {
  with_clock([] {
    errnoSet(S_csLib_BAD_RQST_ID);
    thread other = start_task("other", [] {
      EXPECT_EQ(errnoGet(), 0);
      errnoSet(1);
    });
    other.join();
    EXPECT_EQ(errnoGet(), S_csLib_BAD_RQST_ID);
  });
}

TEST(H2errorLib, MessagesBeginWithTheTasksName) {
  testing::internal::CaptureStderr();
  in_order([] {
    thread task = start_task("arm", [] {
      EXPECT_EQ(logMsg("%d%s\n", 42, "!"), 9);
      errnoSet(S_csLib_BAD_RQST_ID);
      h2perror("moving");
      h2perror(nullptr);
      h2printErrno(0);
    });
    task.join();
  });
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "arm: 42!\narm: moving: S_csLib_BAD_RQST_ID\narm: S_csLib_BAD_RQST_ID\narm: Unknown error\n");
}

TEST(H2errorLib, ListsRecordedMessages) {
  testing::internal::CaptureStdout();
  in_order([] {
    h2recordErrMsgs("test", "arm", 700, 2, arm_errors);
    h2listModules();
    h2listErrors();
  });
  const std::string text = testing::internal::GetCapturedStdout();
  EXPECT_EQ(text.find("Module id      1  M_portLib           ( 5 errors)\n"), 0u) << text;
  EXPECT_NE(text.find("Module id    700  M_arm               ( 2 errors)\n     1 TOO_FAR\n     2 BROKEN\n"), text.npos)
      << text;
}

}  // namespace
}  // namespace waitpoint
