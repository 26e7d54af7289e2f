// SPDX-License-Identifier: BSD-3-Clause
// A program or library in ELF format, as the dynamic linker reads it. Nothing is allocated; a truncated file has no
// parts behind its end.
#pragma once

#include <elf.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace waitpoint::posix {

/// `Read` is a function: bool (void* to, std::size_t size, std::uint64_t from), true if the file has all these bytes.
template <class Read>
class ElfFile {
 public:
  explicit ElfFile(Read read) : read_(read) {
    is_known_ = get(0, head_) && std::memcmp(head_.e_ident, ELFMAG, SELFMAG) == 0 &&
                head_.e_ident[EI_CLASS] == ELFCLASS64 && head_.e_machine == EM_X86_64;
  }

  /// True if it is in that format, and for x86-64; other files have no parts.
  bool is_known() const { return is_known_; }
  /// Of a file that is known.
  const Elf64_Ehdr& head() const { return head_; }

  bool has_part(std::uint32_t type) const {
    Elf64_Phdr part;
    return find_part(part, [type](const Elf64_Phdr& one) { return one.p_type == type; });
  }

  /// False if it has no such part; `is_wanted` is a function: bool (const Elf64_Phdr& part).
  template <class IsWanted>
  bool find_part(Elf64_Phdr& part, IsWanted is_wanted) const {
    if (!is_known_) return false;
    for (std::uint64_t i = 0; i < head_.e_phnum; ++i) {
      if (!get(head_.e_phoff + i * head_.e_phentsize, part)) return false;
      if (is_wanted(part)) return true;
    }
    return false;
  }

  /// What the dynamic section says; 0 if it says nothing.
  std::uint64_t value(std::int64_t tag) const {
    std::uint64_t value = 0;
    find_entry([&](const Elf64_Dyn& entry) {
      if (entry.d_tag == tag) value = entry.d_un.d_val;
      return entry.d_tag == tag;
    });
    return value;
  }

  /// True if the program is linked to a library whose name begins so.
  bool needs_library(std::string_view beginning) const {
    constexpr std::size_t most = 64;
    char name[most];
    if (beginning.size() > most) return false;
    const std::uint64_t address = value(DT_STRTAB);
    Elf64_Phdr names;
    if (!find_part(names, [address](const Elf64_Phdr& part) {
          return part.p_type == PT_LOAD && address >= part.p_vaddr && address - part.p_vaddr < part.p_filesz;
        }))
      return false;
    const std::uint64_t begin = address - names.p_vaddr + names.p_offset;
    return find_entry([&](const Elf64_Dyn& entry) {
      return entry.d_tag == DT_NEEDED && read_(name, beginning.size(), begin + entry.d_un.d_val) &&
             std::memcmp(name, beginning.data(), beginning.size()) == 0;
    });
  }

 private:
  template <class T>
  bool get(std::uint64_t from, T& value) const {
    return read_(&value, sizeof value, from);
  }

  template <class IsWanted>
  bool find_entry(IsWanted is_wanted) const {
    Elf64_Phdr dynamic;
    if (!find_part(dynamic, [](const Elf64_Phdr& part) { return part.p_type == PT_DYNAMIC; })) return false;
    for (std::uint64_t at = 0; at + sizeof(Elf64_Dyn) <= dynamic.p_filesz; at += sizeof(Elf64_Dyn)) {
      Elf64_Dyn entry;
      if (!get(dynamic.p_offset + at, entry) || entry.d_tag == DT_NULL) return false;
      if (is_wanted(entry)) return true;
    }
    return false;
  }

  Read read_;
  Elf64_Ehdr head_{};
  bool is_known_ = false;
};

/// Compiled with -fsanitize=thread, and linked to the compiler's runtime for it.
template <class Read>
bool is_instrumented(const ElfFile<Read>& file) {
  return file.needs_library("libtsan.so.");
}

}  // namespace waitpoint::posix
