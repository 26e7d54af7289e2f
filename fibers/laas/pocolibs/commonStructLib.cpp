// SPDX-License-Identifier: BSD-3-Clause
// A common structure is a block of memory: a head, then the user's bytes.
#include <cstring>

#include "fibers/laas/include/commonStructLib.h"
#include "fibers/laas/pocolibs/memory.hpp"
#include "fibers/laas/semLib.hpp"

namespace laas = waitpoint::laas;

namespace {

struct alignas(std::max_align_t) Head {
  laas::SEM_ID mutex;
  std::size_t size;
};

// Null, with the caller's error code, for other addresses.
Head* head_of(const void* structure) {
  auto* const head = reinterpret_cast<Head*>(const_cast<char*>(static_cast<const char*>(structure)) - sizeof(Head));
  if (structure != nullptr && laas::Memory::here().owns(head)) return head;
  laas::fail(S_commonStructLib_ISNT_COMMON_STRUCT);
  return nullptr;
}

}  // namespace

STATUS commonStructCreate(int len, void** pStructAdrs) {
  const laas::SEM_ID mutex = laas::semMCreate(0);
  if (mutex == nullptr || len < 0) return ERROR;
  auto* const head = static_cast<Head*>(laas::Memory::here().allocate(sizeof(Head) + static_cast<std::size_t>(len)));
  *head = {mutex, static_cast<std::size_t>(len)};
  *pStructAdrs = head + 1;
  return OK;
}

STATUS commonStructDelete(const void* pCommonStruct) {
  Head* const head = head_of(pCommonStruct);
  if (head == nullptr) return ERROR;
  laas::semDelete(head->mutex);
  laas::Memory::here().release(head);
  return OK;
}

STATUS commonStructTake(const void* pCommonStruct) {
  const Head* const head = head_of(pCommonStruct);
  return head != nullptr ? laas::semTake(head->mutex, WAIT_FOREVER) : ERROR;
}

STATUS commonStructGive(const void* pCommonStruct) {
  const Head* const head = head_of(pCommonStruct);
  return head != nullptr ? laas::semGive(head->mutex) : ERROR;
}

STATUS commonStructCopy(void* pCommonStruct, int toFromFlag, void* pBuf) {
  const Head* const head = head_of(pCommonStruct);
  if (head == nullptr || laas::semTake(head->mutex, WAIT_FOREVER) != OK) return ERROR;
  if (toFromFlag == TO)
    std::memcpy(pBuf, pCommonStruct, head->size);
  else
    std::memcpy(pCommonStruct, pBuf, head->size);
  return laas::semGive(head->mutex);
}
