// SPDX-License-Identifier: BSD-3-Clause
// Common structures, shared memory, and symbols.
#include <algorithm>
#include <cstring>

#include "fibers/laas/include/commonStructLib.h"
#include "fibers/laas/include/h2devLib.h"
#include "fibers/laas/include/smMemLib.h"
#include "fibers/laas/include/smObjLib.h"
#include "fibers/laas/include/symLib.h"
#include "tests/fibers/laas/pocolibs/pocolibs_run.hpp"

extern "C" int pocolibs_exported_number;  // NOLINT(misc-use-internal-linkage): found by its name
int pocolibs_exported_number = 42;

namespace waitpoint {
namespace {

struct Pair {
  int first;
  int second;
};

TEST(CommonStructLib, AStructureIsUsedByOneTaskAtATime) {
  with_clock([] {
    void* address = nullptr;
    ASSERT_EQ(commonStructCreate(sizeof(Pair), &address), OK);
    Pair* const shared = static_cast<Pair*>(address);
    EXPECT_EQ(shared->first, 0);
    thread writer = start_task("writer", [shared] {
      for (int i = 1; i <= 5; ++i) {
        commonStructTake(shared);
        shared->first = i;
        taskDelay(1);
        shared->second = i;
        commonStructGive(shared);
      }
    });
    for (int i = 0; i < 10; ++i) {
      Pair copy{-1, -2};
      EXPECT_EQ(commonStructCopy(shared, TO, &copy), OK);
      EXPECT_EQ(copy.first, copy.second);
    }
    writer.join();
    Pair mine{8, 9};
    EXPECT_EQ(commonStructCopy(shared, FROM, &mine), OK);
    EXPECT_EQ(shared->second, 9);
    EXPECT_EQ(commonStructDelete(shared), OK);
    EXPECT_EQ(commonStructTake(shared), ERROR);
    EXPECT_EQ(error_name(), "S_commonStructLib_ISNT_COMMON_STRUCT");
    EXPECT_EQ(commonStructGive(&mine), ERROR);
    EXPECT_EQ(commonStructDelete(nullptr), ERROR);
  });
}

TEST(SmMemLib, BlocksAreZeroedAndLimited) {
  with_clock([] {
    ASSERT_EQ(h2devInit(4096, 10, FALSE), OK);
    char* const block = static_cast<char*>(smMemMalloc(1000));
    ASSERT_NE(block, nullptr);
    EXPECT_TRUE(std::all_of(block, block + 1000, [](char c) { return c == 0; }));
    std::strcpy(block, "kept");
    char* const larger = static_cast<char*>(smMemRealloc(block, 2000));
    EXPECT_STREQ(larger, "kept");
    EXPECT_EQ(smMemMalloc(3000), nullptr);
    EXPECT_EQ(error_name(), "S_portLib_NO_MEMORY");
    EXPECT_EQ(smMemCalloc(1000, 1000), nullptr);
    EXPECT_EQ(smMemFree(larger), OK);
    EXPECT_EQ(smMemFree(larger), ERROR);
    EXPECT_NE(smMemCalloc(100, 30), nullptr);
    EXPECT_EQ(smObjLocalToGlobal(block), block);
    EXPECT_EQ(smObjGlobalToLocal(block), block);
    EXPECT_EQ(smMemAttach(), OK);
  });
}

TEST(SmMemLib, LogsUsedMemory) {
  testing::internal::CaptureStderr();
  in_order([] {
    smMemMalloc(1000);
    smMemShow(0);
  });
  EXPECT_NE(testing::internal::GetCapturedStderr().find(": shared memory: 1032 bytes used, 4193272 free\n"),
            std::string::npos);
}

TEST(SymLib, ExportedAndAddedSymbolsAreFound) {
  with_clock([] {
    char* value = nullptr;
    SYM_TYPE type = SYM_UNDF;
    char exported[] = "pocolibs_exported_number", added[] = "arm_move", unknown[] = "no_such_symbol";
    EXPECT_EQ(symLibInit(), OK);
    EXPECT_EQ(symFindByName(sysSymTbl, exported, &value, &type), OK);
    EXPECT_EQ(reinterpret_cast<int*>(value), &pocolibs_exported_number);
    EXPECT_EQ(symFindByName(sysSymTbl, unknown, &value, &type), ERROR);
    EXPECT_EQ(error_name(), "S_symLib_SYMBOL_NOT_FOUND");
    EXPECT_EQ(symAdd(sysSymTbl, added, added, SYM_TEXT, 0), OK);
    EXPECT_EQ(symFindByName(sysSymTbl, added, &value, &type), OK);
    EXPECT_EQ(value, added);
    EXPECT_EQ(type, SYM_TEXT);
    int offset = 0;
    EXPECT_EQ(symFindByValue(sysSymTbl, value, added, &offset, &type), ERROR);
    EXPECT_EQ(error_name(), "S_symLib_NOT_IMPLEMENTED");
  });
}

}  // namespace
}  // namespace waitpoint
