// SPDX-License-Identifier: BSD-3-Clause
// smMemLib and smObjLib.
#include <algorithm>
#include <cstring>

#include "fibers/laas/include/smMemLib.h"
#include "fibers/laas/include/smObjLib.h"
#include "fibers/laas/pocolibs/memory.hpp"
#include "fibers/laas/portLib.hpp"

namespace laas = waitpoint::laas;

namespace {

struct SharedMemory : waitpoint::sync::RobotState {
  explicit SharedMemory(waitpoint::kernel::Robot&) {}
  std::size_t size = SM_MEM_SIZE;
  std::size_t used = 0;
};

// pocolibs' head of a block.
constexpr std::size_t head_size = 4 * sizeof(unsigned long);

SharedMemory& here() { return waitpoint::sync::state_of<SharedMemory>(*waitpoint::sync::running_task().robot); }

std::size_t taken_by(std::size_t bytes) { return head_size + (bytes + 7) / 8 * 8; }

}  // namespace

STATUS smMemInit(int smMemSize) {
  if (smMemSize > 0) here().size = static_cast<std::size_t>(smMemSize);
  return OK;
}

STATUS smMemAttach() { return OK; }

STATUS smMemEnd() { return OK; }

unsigned long smMemBase() { return 0; }

void* smMemMalloc(size_t nBytes) {
  SharedMemory& memory = here();
  if (nBytes > memory.size || taken_by(nBytes) > memory.size - memory.used) {
    laas::fail(S_portLib_NO_MEMORY);
    return nullptr;
  }
  memory.used += taken_by(nBytes);
  return laas::Memory::here().allocate(nBytes);
}

void* smMemCalloc(size_t elemNum, size_t elemSize) {
  if (elemSize != 0 && elemNum > here().size / elemSize) {
    laas::fail(S_portLib_NO_MEMORY);
    return nullptr;
  }
  return smMemMalloc(elemNum * elemSize);
}

void* smMemRealloc(void* pBlock, size_t newSize) {
  void* const larger = smMemMalloc(newSize);
  if (larger == nullptr || pBlock == nullptr) return larger;
  std::memcpy(larger, pBlock, std::min(newSize, laas::Memory::here().size_of(pBlock)));
  smMemFree(pBlock);
  return larger;
}

STATUS smMemFree(void* ptr) {
  laas::Memory& memory = laas::Memory::here();
  if (!memory.owns(ptr)) return ERROR;
  here().used -= taken_by(memory.size_of(ptr));
  memory.release(ptr);
  return OK;
}

void smMemShow(int) {
  const SharedMemory& memory = here();
  logMsg("shared memory: %zu bytes used, %zu free\n", memory.used, memory.size - memory.used);
}

void* smObjGlobalToLocal(void* globalAdrs) { return globalAdrs; }

void* smObjLocalToGlobal(void* localAdrs) { return localAdrs; }
