// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/base/symbols.hpp"

#include <dlfcn.h>
#include <elf.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <span>

#include "fibers/posix/base/interposed.hpp"

// Of the C++ runtime: demangles without allocating; 0 on success.
extern "C" int __gcclibcxx_demangle_callback(const char* name, void (*add)(const char*, std::size_t, void*), void*);

namespace waitpoint::posix {
namespace {

// A module's file, mapped. The last one is cached.
struct File {
  char name[512] = {};
  const char* bytes = nullptr;
  std::size_t size = 0;

  template <class T>
  std::span<const T> at(std::uint64_t offset, std::uint64_t length) const {
    if (offset > size || length > size - offset) return {};
    return {reinterpret_cast<const T*>(bytes + offset), length / sizeof(T)};
  }
};

const File& open_file(const char* name) {
  static constinit File file;
  if (std::strcmp(name, file.name) == 0 || std::strlen(name) >= sizeof file.name) return file;
  if (file.bytes != nullptr) munmap(const_cast<char*>(file.bytes), file.size);
  file.bytes = nullptr;
  file.size = 0;
  std::strcpy(file.name, name);
  const int descriptor = WAITPOINT_NEXT(open)(name, O_RDONLY | O_CLOEXEC);
  struct stat of {};
  if (descriptor >= 0 && WAITPOINT_NEXT(fstat)(descriptor, &of) == 0 && of.st_size > 0) {
    void* const memory = mmap(nullptr, static_cast<std::size_t>(of.st_size), PROT_READ, MAP_PRIVATE, descriptor, 0);
    if (memory != MAP_FAILED) {
      file.bytes = static_cast<const char*>(memory);
      file.size = static_cast<std::size_t>(of.st_size);
    }
  }
  if (descriptor >= 0) WAITPOINT_NEXT(close)(descriptor);
  return file;
}

struct Found {
  const char* name;
  std::uint64_t offset;  ///< of the address within the variable
};

bool look_up(const File& file, std::uint64_t address, unsigned type, Found& found) {
  const auto head = file.at<Elf64_Ehdr>(0, sizeof(Elf64_Ehdr));
  if (head.empty() || std::memcmp(head[0].e_ident, ELFMAG, SELFMAG) != 0) return false;
  const auto sections = file.at<Elf64_Shdr>(head[0].e_shoff, std::uint64_t{head[0].e_shnum} * sizeof(Elf64_Shdr));
  for (const Elf64_Shdr& section : sections) {
    if (section.sh_type != SHT_SYMTAB || section.sh_link >= sections.size()) continue;
    const auto names = file.at<char>(sections[section.sh_link].sh_offset, sections[section.sh_link].sh_size);
    for (const Elf64_Sym& symbol : file.at<Elf64_Sym>(section.sh_offset, section.sh_size)) {
      const std::uint64_t into = address - symbol.st_value;
      if (ELF64_ST_TYPE(symbol.st_info) != type || into >= symbol.st_size || symbol.st_name >= names.size()) continue;
      found = {names.data() + symbol.st_name, into};
      return true;
    }
  }
  return false;
}

// The strings returned, one after the other.
class Pool {
 public:
  void add(const char* text, std::size_t length) {
    WAITPOINT_CHECK(end_ < sizeof bytes_, "the strings of symbols exceed their memory");
    if (length >= sizeof bytes_ - end_) length = sizeof bytes_ - end_ - 1;
    std::memcpy(bytes_ + end_, text, length);
    end_ += length;
  }
  const char* finish() {
    WAITPOINT_CHECK(begin_ <= end_ && end_ < sizeof bytes_, "the string of a symbol is outside its memory");
    const char* const text = bytes_ + begin_;
    bytes_[end_] = '\0';
    if (end_ + 1 < sizeof bytes_) ++end_;
    begin_ = end_;
    return text;
  }

 private:
  char bytes_[1 << 16] = {};
  std::size_t begin_ = 0, end_ = 0;
};
Pool pool;

const char* kept(const Found& found) {
  const auto add = [](const char* text, std::size_t length, void*) { pool.add(text, length); };
  const bool is_mangled = std::strncmp(found.name, "_Z", 2) == 0;
  if (!is_mangled || __gcclibcxx_demangle_callback(found.name, add, nullptr) != 0)
    pool.add(found.name, std::strlen(found.name));
  char offset[32] = "";
  if (found.offset != 0) std::snprintf(offset, sizeof offset, "+%llu", static_cast<unsigned long long>(found.offset));
  pool.add(offset, std::strlen(offset));
  return pool.finish();
}

const File& file_of(const Dl_info& info) {
  const bool is_program = std::strcmp(info.dli_fname, program_invocation_name) == 0;
  return open_file(is_program ? "/proc/self/exe" : info.dli_fname);
}

// The symbols of a program linked at fixed addresses hold absolute addresses.
std::uintptr_t offset_in(const File& file, const Dl_info& info, const void* address) {
  const auto head = file.at<Elf64_Ehdr>(0, sizeof(Elf64_Ehdr));
  const bool is_fixed = !head.empty() && head[0].e_type == ET_EXEC;
  const auto* const base = static_cast<const char*>(is_fixed ? nullptr : info.dli_fbase);
  return static_cast<std::uintptr_t>(static_cast<const char*>(address) - base);
}

}  // namespace

const char* symbol_at(const void* address) {
  Dl_info info{};
  if (dladdr(address, &info) == 0 || info.dli_fname == nullptr) return nullptr;
  const File& file = file_of(info);
  Found found{};
  if (look_up(file, offset_in(file, info, address), STT_OBJECT, found)) return kept(found);
  if (info.dli_sname == nullptr) return nullptr;
  const auto into = static_cast<const char*>(address) - static_cast<const char*>(info.dli_saddr);
  return kept({info.dli_sname, static_cast<std::uint64_t>(into)});
}

std::uintptr_t function_at(const void* address, const char*& function) {
  function = nullptr;
  Dl_info info{};
  if (dladdr(address, &info) == 0 || info.dli_fname == nullptr) return 0;
  const File& file = file_of(info);
  const std::uintptr_t offset = offset_in(file, info, address);
  Found found{};
  if (look_up(file, offset, STT_FUNC, found))
    function = kept({found.name, 0});
  else if (info.dli_sname != nullptr)
    function = kept({info.dli_sname, 0});
  return offset;
}

}  // namespace waitpoint::posix
