// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/laas/include/h2devLib.h"

#include <cerrno>

#include "fibers/laas/include/mboxLib.h"
#include "fibers/laas/include/posterLib.h"
#include "tests/fibers/laas/pocolibs/pocolibs_run.hpp"

namespace waitpoint {
namespace {

TEST(H2devLib, DevicesAreFoundByNameAndType) {
  with_clock([] {
    const int device = h2devAlloc("arm", H2_DEV_TYPE_MEM);
    EXPECT_EQ(device, 1);
    EXPECT_EQ(h2devFind("arm", H2_DEV_TYPE_MEM), device);
    EXPECT_EQ(h2devFind("arm", H2_DEV_TYPE_TASK), ERROR);
    EXPECT_EQ(error_name(), "S_h2devLib_NOT_FOUND");
    EXPECT_EQ(h2devAlloc("arm", H2_DEV_TYPE_MEM), ERROR);
    EXPECT_EQ(error_name(), "S_h2devLib_DUPLICATE_DEVICE_NAME");
    EXPECT_EQ(h2devAlloc("arm", H2_DEV_TYPE_TASK), 2);
    EXPECT_STREQ(H2DEV_NAME(device), "arm");
    EXPECT_EQ(H2DEV_TYPE(device), H2_DEV_TYPE_MEM);
    EXPECT_EQ(static_cast<int>(H2DEV_BY_INDEX(1)), device);
  });
}

TEST(H2devLib, APlaceIsUsedAgainWithAnotherId) {
  with_clock([] {
    const int first = h2devAlloc("arm", H2_DEV_TYPE_MEM);
    EXPECT_EQ(h2devFree(first), OK);
    EXPECT_EQ(h2devFree(first), ERROR);
    const int second = h2devAlloc("arm", H2_DEV_TYPE_MEM);
    EXPECT_NE(second, first);
    EXPECT_EQ(H2DEV_INDEX(second), 1u);
    EXPECT_EQ(H2DEV_GEN(second), 1u);
    EXPECT_EQ(H2DEV_TYPE(first), H2_DEV_TYPE_NONE);
  });
}

TEST(H2devLib, TheTableHasTheSizeThatWasAskedFor) {
  with_clock([] {
    EXPECT_EQ(h2devSize(), H2_DEV_MAX_DEFAULT);
    EXPECT_EQ(h2devEnd(), ERROR);  // nobody has made it
    ASSERT_EQ(h2devInit(1 << 20, 3, FALSE), OK);
    EXPECT_EQ(h2devInit(1 << 20, 3, FALSE), ERROR);
    EXPECT_EQ(errnoGet(), EEXIST);
    h2devAlloc("a", H2_DEV_TYPE_MEM);
    h2devAlloc("b", H2_DEV_TYPE_MEM);
    EXPECT_EQ(h2devAlloc("c", H2_DEV_TYPE_MEM), ERROR);
    EXPECT_EQ(error_name(), "S_h2devLib_FULL");
    EXPECT_EQ(h2devEnd(), OK);
    EXPECT_EQ(h2devAlloc("c", H2_DEV_TYPE_MEM), ERROR);
    EXPECT_EQ(error_name(), "S_h2devLib_NOT_INITIALIZED");
    EXPECT_EQ(h2devSize(), ERROR);
    EXPECT_EQ(h2devInit(1 << 20, -1, FALSE), ERROR);
    EXPECT_EQ(error_name(), "S_h2devLib_TOO_MANY_DEVICES");
    ASSERT_EQ(h2devInit(1 << 20, 3, FALSE), OK);
    EXPECT_EQ(h2devAlloc("c", H2_DEV_TYPE_MEM), 1);
  });
}

TEST(H2devLib, NamesHaveAtMost31Characters) {
  with_clock([] {
    EXPECT_NE(h2devAlloc("a name of thirty-one characters", H2_DEV_TYPE_MEM), ERROR);
    EXPECT_EQ(h2devAlloc("a name of thirty-two characters!", H2_DEV_TYPE_MEM), ERROR);
    EXPECT_EQ(error_name(), "S_h2devLib_BAD_PARAMETERS");
    EXPECT_EQ(h2devFind(nullptr, H2_DEV_TYPE_MEM), ERROR);
  });
}

TEST(H2devLib, CleaningDeletesWhatAPatternNames) {
  with_clock([] {
    MBOX_ID mailbox = 0;
    POSTER_ID poster = nullptr, other = nullptr;
    mboxCreate("arm mailbox", 100, &mailbox);
    posterCreate("arm state", 4, &poster);
    posterCreate("leg state", 4, &other);
    EXPECT_EQ(h2devClean("arm*"), OK);
    EXPECT_EQ(mboxFind("arm mailbox", &mailbox), ERROR);
    EXPECT_EQ(posterFind("arm state", &poster), ERROR);
    EXPECT_EQ(posterFind("leg state", &poster), OK);
    EXPECT_EQ(h2devClean("arm*"), ERROR);
  });
}

TEST(H2devLib, TheTableIsPrinted) {
  testing::internal::CaptureStdout();
  in_order([] {
    h2devAlloc("arm", H2_DEV_TYPE_MEM);
    h2devShow();
  });
  EXPECT_EQ(testing::internal::GetCapturedStdout(),
            "      Id  Gen   Type   UID Name\n"
            "       0    0    SEM     0 h2semLib\n"
            "       1    0    MEM     0 arm\n");
}

}  // namespace
}  // namespace waitpoint
