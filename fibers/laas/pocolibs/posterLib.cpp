// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstring>

#include "fibers/laas/include/smMemLib.h"
#include "fibers/laas/pocolibs/posters.hpp"

namespace laas = waitpoint::laas;
using laas::fail;
using laas::Poster;
using laas::Posters;
using waitpoint::kernel::Operation;

namespace {

// Null, with the caller's error code, for a closed poster.
Poster* find(POSTER_ID id) {
  auto* const poster = static_cast<Poster*>(id);
  if (poster != nullptr && poster->open) return poster;
  fail(S_posterLib_POSTER_CLOSED);
  return nullptr;
}

// The bytes of [offset, offset + bytes) that the poster has; 0, with the caller's error code, if none.
int within(const Poster& poster, int offset, int bytes) {
  const int available = offset < 0 ? 0 : std::min(bytes, static_cast<int>(poster.size) - offset);
  if (available > 0) return available;
  fail(S_posterLib_BAD_FORMAT);
  return 0;
}

void* at(const Poster& poster, int offset) { return static_cast<char*>(poster.memory) + offset; }

STATUS resize(Poster& poster, std::size_t size) {
  if (size == poster.size) return OK;
  void* const memory = smMemRealloc(poster.memory, size);
  if (memory == nullptr) return fail(S_posterLib_MALLOC_ERROR);
  poster.memory = memory;
  poster.size = size;
  poster.fresh = false;
  return OK;
}

STATUS get_date(const Poster& poster, int code, void* result) {
  if (!poster.fresh) return fail(S_posterLib_EMPTY_POSTER);
  if (code == FIO_NMSEC) return h2timespecInterval(&poster.date, static_cast<unsigned long*>(result));
  h2timeFromTimespec(static_cast<H2TIME*>(result), &poster.date);
  return OK;
}

STATUS do_ioctl(Poster& poster, int code, void* argument) {
  switch (code) {
    case FIO_GETDATE:
    case FIO_NMSEC: return get_date(poster, code, argument);
    case FIO_GETSIZE: *static_cast<std::size_t*>(argument) = poster.size; return OK;
    case FIO_FRESH: *static_cast<int*>(argument) = poster.fresh ? TRUE : FALSE; return OK;
    case FIO_GETSTATS:
      *static_cast<H2_POSTER_STAT_STR*>(argument) = poster.statistics;
      poster.statistics = {};
      return OK;
    case FIO_RESIZE: return resize(poster, *static_cast<std::size_t*>(argument));
    default: return fail(S_posterLib_BAD_IOCTL_CODE);
  }
}

}  // namespace

STATUS posterCreate(const char* name, int size, POSTER_ID* pPosterId) {
  if (pPosterId == nullptr || size < 0) return ERROR;
  *pPosterId = Posters::here().create(name, static_cast<std::size_t>(size));
  return *pPosterId != nullptr ? OK : ERROR;
}

STATUS posterMemCreate(const char*, int, void*, int, POSTER_ID*) {
  logMsg("posterMemCreate: Not supported under Unix\n");
  return ERROR;
}

STATUS posterDelete(POSTER_ID dev) {
  const Poster* const poster = find(dev);
  if (poster == nullptr) return ERROR;
  Posters::here().close(poster->device);
  return OK;
}

STATUS posterFind(const char* name, POSTER_ID* pPosterId) {
  if (pPosterId == nullptr) return ERROR;
  const int device = h2devFind(name, H2_DEV_TYPE_POSTER);
  if (device == ERROR) return ERROR;
  *pPosterId = Posters::here().find(device);
  return *pPosterId != nullptr ? OK : ERROR;
}

STATUS posterForget(POSTER_ID posterId) { return find(posterId) != nullptr ? OK : ERROR; }

int posterWrite(POSTER_ID posterId, int offset, void* buf, int nbytes) {
  if (posterTake(posterId, POSTER_WRITE) == ERROR) return ERROR;
  Poster& poster = *static_cast<Poster*>(posterId);
  const int bytes = within(poster, offset, nbytes);
  if (bytes == 0) {
    poster.access.give();  // nothing was written; pocolibs leaves the poster taken
    return 0;
  }
  std::memcpy(at(poster, offset), buf, static_cast<std::size_t>(bytes));
  ++poster.statistics.write_ops;
  poster.statistics.write_bytes += static_cast<unsigned>(bytes);
  posterGive(posterId);
  return bytes;
}

int posterRead(POSTER_ID posterId, int offset, void* buf, int nbytes) {
  Poster* const poster = find(posterId);
  if (poster == nullptr) return ERROR;
  if (within(*poster, offset, nbytes) == 0) return 0;
  if (posterTake(posterId, POSTER_READ) == ERROR) return ERROR;
  const int bytes = within(*poster, offset, nbytes);
  std::memcpy(buf, at(*poster, offset), static_cast<std::size_t>(bytes));
  ++poster->statistics.read_ops;
  poster->statistics.read_bytes += static_cast<unsigned>(bytes);
  posterGive(posterId);
  return bytes;
}

STATUS posterTake(POSTER_ID posterId, POSTER_OP op) {
  Poster* const poster = find(posterId);
  if (poster == nullptr) return ERROR;
  if (op != POSTER_READ && op != POSTER_WRITE && op != POSTER_IOCTL) return fail(S_posterLib_BAD_OP);
  if (op == POSTER_READ && waitpoint::sync::before_blocking(Operation::poll, poster->access.object()) && !poster->fresh)
    return fail(poster->open ? S_posterLib_EMPTY_POSTER : S_posterLib_POSTER_CLOSED);
  if (poster->access.take(WAIT_FOREVER) != laas::TakeResult::taken) return fail(S_posterLib_POSTER_CLOSED);
  poster->operation = op;
  return OK;
}

STATUS posterGive(POSTER_ID posterId) {
  Poster* const poster = find(posterId);
  if (poster == nullptr) return ERROR;
  if (poster->operation == POSTER_WRITE) {
    poster->fresh = true;
    h2GetTimeSpec(&poster->date);
  }
  const int error = poster->access.give();
  return error == 0 ? OK : fail(error);
}

void* posterAddr(POSTER_ID posterId) {
  const Poster* const poster = find(posterId);
  return poster != nullptr ? poster->memory : nullptr;
}

STATUS posterIoctl(POSTER_ID posterId, int code, void* parg) {
  if (posterTake(posterId, POSTER_IOCTL) == ERROR) return ERROR;
  const STATUS done = do_ioctl(*static_cast<Poster*>(posterId), code, parg);
  posterGive(posterId);
  return done;
}

STATUS posterEndianness(POSTER_ID posterId, H2_ENDIANNESS* endianness) {
  const Poster* const poster = find(posterId);
  if (poster == nullptr) return ERROR;
  *endianness = poster->endianness;
  return OK;
}

STATUS posterSetEndianness(POSTER_ID posterId, H2_ENDIANNESS endianness) {
  Poster* const poster = find(posterId);
  if (poster == nullptr) return ERROR;
  poster->endianness = endianness;
  return OK;
}

char* posterName(POSTER_ID posterId) { return static_cast<Poster*>(posterId)->name.data(); }
