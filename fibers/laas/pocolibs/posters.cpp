// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/laas/pocolibs/posters.hpp"

#include "fibers/laas/include/smMemLib.h"

namespace waitpoint::laas {

Poster* Posters::create(const char* name, std::size_t size) {
  const int device = h2devAlloc(name, H2_DEV_TYPE_POSTER);
  if (device == ERROR) return nullptr;
  void* const memory = smMemMalloc(size);
  if (memory == nullptr) {
    h2devFree(device);
    fail(S_posterLib_MALLOC_ERROR);
    return nullptr;
  }
  Poster& poster = all_.emplace_back(robot_, name);
  poster.access.object().label = poster.name.c_str();
  poster.access.create(Semaphore::Kind::count, 1);
  poster.access.object().kind = "poster";
  poster.device = device;
  poster.memory = memory;
  poster.size = size;
  poster.endianness = h2localEndianness();
  return &poster;
}

Poster* Posters::find(int device) {
  for (Poster& poster : all_)
    if (poster.open && poster.device == device) return &poster;
  return nullptr;
}

void Posters::close(int device) {
  Poster* const poster = find(device);
  if (poster == nullptr || !sync::before_releasing(kernel::Operation::close, poster->access.object())) return;
  poster->open = false;
  poster->access.destroy();
  smMemFree(poster->memory);
  h2devFree(device);
}

}  // namespace waitpoint::laas
