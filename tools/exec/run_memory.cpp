// SPDX-License-Identifier: BSD-3-Clause
#include "tools/exec/run_memory.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/error.hpp"

namespace waitpoint::tools {
namespace {

[[noreturn]] void no_memory() { throw BadInput("exec", std::string("cannot share memory: ") + std::strerror(errno)); }

}  // namespace

RunMemory::RunMemory(const posix::Settings& settings) {
  const int made = memfd_create("waitpoint-exec", 0);
  descriptor_ = fcntl(made, F_DUPFD, least_descriptor);
  if (descriptor_ >= 0)
    close(made);
  else
    descriptor_ = made;
  if (descriptor_ < 0 || ftruncate(descriptor_, posix::run_bytes) != 0) no_memory();
  void* const memory = mmap(reinterpret_cast<void*>(posix::record_address), posix::run_bytes, PROT_READ | PROT_WRITE,
                            MAP_SHARED | MAP_NORESERVE | MAP_FIXED_NOREPLACE, descriptor_, 0);
  if (memory == MAP_FAILED) no_memory();
  record_ = new (memory) posix::Record();
  record_->settings = settings;
  record_->file = {getpid(), descriptor_};
}

RunMemory::~RunMemory() {
  munmap(record_, posix::run_bytes);
  close(descriptor_);
}

}  // namespace waitpoint::tools
