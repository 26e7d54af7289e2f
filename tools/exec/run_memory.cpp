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

[[noreturn]] void no_memory() {
  // The memory has one address, which is in use in a simulated process.
  if (errno == EEXIST) throw BadInput("exec", "a simulated program cannot start a simulation of its own");
  throw BadInput("exec", std::string("cannot share memory: ") + std::strerror(errno));
}

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
  record_ = static_cast<posix::Record*>(memory);
  begin(settings);
}

void RunMemory::begin(const posix::Settings& settings) {
  new (record_) posix::Record();
  record_->settings = settings;
  record_->file = {getpid(), descriptor_};
}

void RunMemory::begin_anew(const posix::Settings& settings) {
  if (fallocate(descriptor_, FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE, 0, posix::run_bytes) != 0) no_memory();
  begin(settings);
}

RunMemory::~RunMemory() {
  munmap(record_, posix::run_bytes);
  close(descriptor_);
}

}  // namespace waitpoint::tools
