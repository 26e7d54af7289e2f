// SPDX-License-Identifier: BSD-3-Clause
#include <fnmatch.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <vector>

#include "fibers/laas/include/h2devLib.h"
#include "fibers/laas/include/mboxLib.h"
#include "fibers/laas/include/smMemLib.h"
#include "fibers/laas/pocolibs/posters.hpp"
#include "fibers/laas/portLib.hpp"
#include "fibers/sync/blocking.hpp"
#include "fibers/sync/robot_state.hpp"

using waitpoint::kernel::Operation;
using waitpoint::laas::fail;

namespace {

constexpr unsigned generation_shift = 8 * sizeof(int) - H2_DEV_GEN_BITS;

struct Devices : waitpoint::sync::RobotState {
  explicit Devices(waitpoint::kernel::Robot&) { clear(H2_DEV_MAX_DEFAULT); }

  // Device 0 is pocolibs' table of semaphores. The first use of a place has generation 0.
  void clear(unsigned size) {
    table.assign(size, {});
    for (unsigned i = 1; i < size; ++i) table[i].devgen = i | ~0u << generation_shift;
    table[0].type = H2_DEV_TYPE_SEM;
    std::strcpy(table[0].name, "h2semLib");
  }

  waitpoint::kernel::Object object{"h2 devices"};
  std::vector<H2_DEV_STR> table;
  bool initialised = false;  // by h2devInit()
  bool ended = false;
};

Devices& here() { return waitpoint::sync::state_of<Devices>(*waitpoint::sync::running_task().robot); }

const H2_DEV_STR none{};

const H2_DEV_STR* find(const Devices& devices, const char* name, H2_DEV_TYPE type) {
  for (const H2_DEV_STR& device : devices.table)
    if (device.type == type && std::strcmp(device.name, name) == 0) return &device;
  return nullptr;
}

// Of a mailbox or poster, with its memory; of another device, its place.
void remove(const H2_DEV_STR& device) {
  const int id = static_cast<int>(device.devgen);
  if (device.type == H2_DEV_TYPE_MBOX)
    mboxDelete(id);
  else if (device.type == H2_DEV_TYPE_POSTER)
    waitpoint::laas::Posters::here().close(id);
  else if (device.type != H2_DEV_TYPE_NONE && device.type != H2_DEV_TYPE_SEM)
    h2devFree(id);
}

const char* name_of(H2_DEV_TYPE type) {
  constexpr const char* names[] = {"NONE", "H2DEV", "SEM", "MBOX", "POSTER", "TASK", "MEM"};
  return names[type];
}

}  // namespace

STATUS h2devInit(int smMemSize, int h2devMax, int) {
  Devices& devices = here();
  if (!waitpoint::sync::before_releasing(Operation::open, devices.object)) return ERROR;
  if (devices.initialised) return fail(EEXIST);
  if (h2devMax < 1 || static_cast<unsigned>(h2devMax) > H2DEV_INDEX(-1)) return fail(S_h2devLib_TOO_MANY_DEVICES);
  devices.clear(static_cast<unsigned>(h2devMax));
  devices.initialised = true;
  devices.ended = false;
  return smMemInit(smMemSize);
}

STATUS h2devAttach(int* h2devMax) {
  const Devices& devices = here();
  if (devices.ended) return fail(S_h2devLib_NOT_INITIALIZED);
  if (h2devMax != nullptr) *h2devMax = static_cast<int>(devices.table.size());
  return OK;
}

int h2devSize() {
  int size = 0;
  return h2devAttach(&size) == OK ? size : ERROR;
}

STATUS h2devEnd() {
  Devices& devices = here();
  if (!devices.initialised) return fail(S_h2devLib_NOT_INITIALIZED);
  for (std::size_t i = 0; i < devices.table.size(); ++i) remove(devices.table[i]);
  devices.initialised = false;
  devices.ended = true;
  return OK;
}

int h2devAlloc(const char* name, H2_DEV_TYPE type) {
  Devices& devices = here();
  if (h2devAttach(nullptr) == ERROR || !waitpoint::sync::before_releasing(Operation::open, devices.object))
    return ERROR;
  if (std::strlen(name) >= H2_DEV_MAX_NAME) return fail(S_h2devLib_BAD_PARAMETERS);
  if (type != H2_DEV_TYPE_SEM && find(devices, name, type) != nullptr) return fail(S_h2devLib_DUPLICATE_DEVICE_NAME);
  for (H2_DEV_STR& device : devices.table) {
    if (device.type != H2_DEV_TYPE_NONE) continue;
    device.type = type;
    std::strcpy(device.name, name);
    device.devgen += 1u << generation_shift;
    return static_cast<int>(device.devgen);
  }
  return fail(S_h2devLib_FULL);
}

int h2devFind(const char* name, H2_DEV_TYPE type) {
  if (name == nullptr) return fail(S_h2devLib_BAD_PARAMETERS);
  Devices& devices = here();
  if (h2devAttach(nullptr) == ERROR || !waitpoint::sync::before_releasing(Operation::connect, devices.object))
    return ERROR;
  const H2_DEV_STR* const found = find(devices, name, type);
  return found != nullptr ? static_cast<int>(found->devgen) : fail(S_h2devLib_NOT_FOUND);
}

STATUS h2devFree(int dev) {
  Devices& devices = here();
  if (h2devAttach(nullptr) == ERROR || !waitpoint::sync::before_releasing(Operation::close, devices.object))
    return ERROR;
  if (h2devById(dev)->type == H2_DEV_TYPE_NONE) return fail(S_h2devLib_NOT_OWNER);
  devices.table[H2DEV_INDEX(dev)].type = H2_DEV_TYPE_NONE;
  return OK;
}

STATUS h2devClean(const char* name) {
  if (h2devAttach(nullptr) == ERROR) return ERROR;
  const Devices& devices = here();
  int cleaned = 0;
  for (std::size_t i = 0; i < devices.table.size(); ++i) {
    const H2_DEV_STR& device = devices.table[i];
    if (device.type == H2_DEV_TYPE_NONE || fnmatch(name, device.name, 0) != 0) continue;
    logMsg("Freeing %s\n", device.name);
    remove(device);
    ++cleaned;
  }
  if (cleaned == 0) logMsg("No matching device\n");
  return cleaned > 0 ? OK : ERROR;
}

STATUS h2devShow() {
  if (h2devAttach(nullptr) == ERROR) return ERROR;
  std::printf("      Id  Gen   Type   UID Name\n");
  for (const H2_DEV_STR& device : here().table)
    if (device.type != H2_DEV_TYPE_NONE)
      std::printf("%8u %4u %6s %5ld %s\n", H2DEV_INDEX(device.devgen), H2DEV_GEN(device.devgen), name_of(device.type),
                  device.uid, device.name);
  return OK;
}

const H2_DEV_STR* h2devByIndex(unsigned index) {
  const auto& table = here().table;
  return index < table.size() ? &table[index] : &none;
}

const H2_DEV_STR* h2devById(int dev) {
  const H2_DEV_STR* const device = h2devByIndex(H2DEV_INDEX(dev));
  return device->devgen == static_cast<unsigned>(dev) ? device : &none;
}
