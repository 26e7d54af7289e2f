// SPDX-License-Identifier: BSD-3-Clause
#include "tools/exec/run_memory.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <span>

#include "core/error.hpp"
#include "tools/exec/family_report.hpp"

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

void RunMemory::discard() const {
  const auto discard = [this](std::size_t from, std::size_t bytes) {
    return fallocate(descriptor_, FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE, static_cast<off_t>(from),
                     static_cast<off_t>(bytes)) == 0;
  };
  if (!discard(0, posix::record_bytes - posix::control_bytes) || !discard(posix::record_bytes, posix::family_bytes))
    no_memory();
}

// Pages that stay need not be allocated and mapped again.
bool RunMemory::clear() const {
  constexpr std::ptrdiff_t little = std::ptrdiff_t{1} << 20;
  struct Part {
    void* begin;
    const void* end;
    std::ptrdiff_t bytes() const { return static_cast<const char*>(end) - static_cast<char*>(begin); }
  };
  posix::family::Family& family = family_of(*record_);
  const std::span<posix::family::Process> processes = entries_of(family);
  const Part parts[] = {{record_, record_->arena.top()},
                        {&family, processes.data() + processes.size()},
                        {&family + 1, family.arena.top()}};
  for (const Part& part : parts)
    if (part.bytes() < 0 || part.bytes() > little) return false;
  for (const Part& part : parts) std::memset(part.begin, 0, static_cast<std::size_t>(part.bytes()));
  return true;
}

void RunMemory::begin_anew(const posix::Settings& settings, bool was_orderly) {
  if (!was_orderly || !clear()) discard();
  begin(settings);
}

RunMemory::~RunMemory() {
  munmap(record_, posix::run_bytes);
  close(descriptor_);
}

}  // namespace waitpoint::tools
