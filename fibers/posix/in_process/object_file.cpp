// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/in_process/object_file.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>

#include "fibers/posix/base/interposed.hpp"

namespace waitpoint::posix {

FileBytes::FileBytes(const char* file, LoadError& error) {
  const int descriptor = open(file, O_RDONLY | O_CLOEXEC);
  struct stat of {};
  if (descriptor < 0 || WAITPOINT_NEXT(fstat)(descriptor, &of) != 0) {
    std::snprintf(error, sizeof error, "there is no program '%s': %s", file, std::strerror(errno));
  } else if (!S_ISREG(of.st_mode) || of.st_size < static_cast<off_t>(sizeof(Elf64_Ehdr))) {
    std::snprintf(error, sizeof error, "%s is no shared object", file);
  } else {
    size_ = static_cast<std::size_t>(of.st_size);
    void* const memory = mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_PRIVATE, descriptor, 0);
    if (memory != MAP_FAILED)
      begin_ = static_cast<char*>(memory);
    else
      std::snprintf(error, sizeof error, "%s cannot be read: %s", file, std::strerror(errno));
  }
  if (descriptor >= 0) WAITPOINT_NEXT(close)(descriptor);
}

FileBytes::~FileBytes() {
  if (begin_ != nullptr) munmap(begin_, size_);
}

std::size_t ObjectFile::symbols() const {
  if (const std::uint32_t* const table = hash_table(DT_HASH); table != nullptr) return table[1];
  const std::uint64_t table = value(DT_GNU_HASH);
  const std::uint32_t* const head = hash_table(DT_GNU_HASH);
  if (head == nullptr) return 0;
  const std::uint32_t buckets = head[0], first_hashed = head[1], words = head[2];
  const std::uint64_t at = table + 16 + std::uint64_t{words} * 8;
  std::uint32_t last = 0;
  for (std::uint32_t i = 0; i < buckets; ++i)
    if (const auto* bucket = loaded<std::uint32_t>(at + std::uint64_t{i} * 4); bucket != nullptr && *bucket > last)
      last = *bucket;
  if (last < first_hashed) return first_hashed;
  const std::uint64_t chains = at + std::uint64_t{buckets} * 4;
  for (;; ++last) {
    const auto* const hash = loaded<std::uint32_t>(chains + std::uint64_t{last - first_hashed} * 4);
    if (hash == nullptr || (*hash & 1) != 0) return last + 1;
  }
}

}  // namespace waitpoint::posix
