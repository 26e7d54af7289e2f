// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/traps/memory_peek.hpp"

#include <sys/syscall.h>
#include <sys/uio.h>

#include "fibers/posix/base/direct_call.hpp"

namespace waitpoint::posix {
namespace {

bool transfer(long call, std::uint64_t address, void* own, std::size_t bytes) {
  const iovec here{own, bytes}, there{reinterpret_cast<void*>(address), bytes};
  const long process = call_directly(SYS_getpid);
  return call_directly(call, process, reinterpret_cast<long>(&here), 1, reinterpret_cast<long>(&there), 1, 0) ==
         static_cast<long>(bytes);
}

}  // namespace

bool peek(std::uint64_t address, void* to, std::size_t bytes) {
  return transfer(SYS_process_vm_readv, address, to, bytes);
}

bool poke(std::uint64_t address, const void* from, std::size_t bytes) {
  return transfer(SYS_process_vm_writev, address, const_cast<void*>(from), bytes);
}

}  // namespace waitpoint::posix
