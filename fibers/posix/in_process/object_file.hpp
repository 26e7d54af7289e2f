// SPDX-License-Identifier: BSD-3-Clause
// The file of a program or library in ELF format, in memory, so that it can be changed before it is copied.
#pragma once

#include <elf.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace waitpoint::posix {

/// The reason for a failure, as a clause: "FILE ...".
using LoadError = char[512];

/// A file's bytes, mapped privately.
class FileBytes {
 public:
  FileBytes(const char* file, LoadError& error);
  ~FileBytes();
  FileBytes(const FileBytes&) = delete;
  FileBytes& operator=(const FileBytes&) = delete;

  bool read() const { return begin_ != nullptr; }
  std::size_t size() const { return size_; }
  const char* begin() const { return begin_; }
  /// `count` objects at `offset`; null beyond the end of the file.
  template <class T>
  T* at(std::uint64_t offset, std::uint64_t count = 1) const {
    return offset <= size_ && count <= (size_ - offset) / sizeof(T) ? reinterpret_cast<T*>(begin_ + offset) : nullptr;
  }

 private:
  char* begin_ = nullptr;
  std::size_t size_ = 0;
};

class ObjectFile {
 public:
  /// A tag unknown to the dynamic linker.
  static constexpr Elf64_Sxword no_tag = DT_LOOS + 0x5770;
  static_assert(no_tag > DT_LOOS && no_tag < DT_HIOS, "the tag is one that systems may define");
  static_assert(sizeof(Elf64_Sym) == 24 && sizeof(Elf64_Rela) == 24 && sizeof(Elf64_Dyn) == 16);

  explicit ObjectFile(const FileBytes& bytes) : bytes_(bytes), head_(*bytes.at<Elf64_Ehdr>(0)) {
    parts_ = bytes.at<Elf64_Phdr>(head_.e_phoff, head_.e_phnum);
  }

  bool is_elf() const {
    return std::memcmp(head_.e_ident, ELFMAG, SELFMAG) == 0 && head_.e_ident[EI_CLASS] == ELFCLASS64 &&
           head_.e_machine == EM_X86_64 && parts_ != nullptr;
  }
  bool is_position_independent() const { return head_.e_type == ET_DYN; }
  bool is_executable() const { return part(PT_INTERP) != nullptr; }

  Elf64_Ehdr& head() const { return head_; }
  std::span<const Elf64_Phdr> parts() const { return {parts_, head_.e_phnum}; }
  /// What debuggers read; empty without it.
  std::span<Elf64_Shdr> sections() const {
    auto* const first = bytes_.at<Elf64_Shdr>(head_.e_shoff, head_.e_shnum);
    return {first, first != nullptr ? head_.e_shnum : std::size_t{0}};
  }

  /// Finds the dynamic section; false without one.
  bool find_dynamic() {
    const Elf64_Phdr* const section = part(PT_DYNAMIC);
    if (section == nullptr) return false;
    count_ = section->p_filesz / sizeof(Elf64_Dyn);
    entries_ = bytes_.at<Elf64_Dyn>(section->p_offset, count_);
    if (entries_ == nullptr) return false;
    for (std::size_t i = 0; i < count_; ++i)
      if (entries_[i].d_tag == DT_NULL) count_ = i;
    return true;
  }
  /// Its entries, up to the end.
  std::span<Elf64_Dyn> dynamic() const { return {entries_, count_}; }
  Elf64_Dyn* find(Elf64_Sxword tag) const {
    for (Elf64_Dyn& entry : dynamic())
      if (entry.d_tag == tag) return &entry;
    return nullptr;
  }
  std::uint64_t value(Elf64_Sxword tag) const {
    const Elf64_Dyn* const entry = find(tag);
    return entry != nullptr ? entry->d_un.d_val : 0;
  }
  /// Returns the value and makes the entry void.
  std::uint64_t take(Elf64_Sxword tag) {
    Elf64_Dyn* const entry = find(tag);
    if (entry == nullptr) return 0;
    entry->d_tag = no_tag;
    return entry->d_un.d_val;
  }

  /// The objects loaded at `address`; null if they are not in the file.
  template <class T>
  T* loaded(std::uint64_t address, std::uint64_t count = 1) const {
    for (std::size_t i = 0; i < head_.e_phnum; ++i) {
      const Elf64_Phdr& part = parts_[i];
      if (part.p_type == PT_LOAD && address >= part.p_vaddr && address - part.p_vaddr < part.p_filesz)
        return bytes_.at<T>(part.p_offset + (address - part.p_vaddr), count);
    }
    return nullptr;
  }

  Elf64_Sym* symbol(std::size_t number) const {
    return loaded<Elf64_Sym>(value(DT_SYMTAB) + number * sizeof(Elf64_Sym));
  }
  /// The string at this offset of the table of strings; null behind the end of the file.
  const char* text(std::uint64_t offset) const { return loaded<char>(value(DT_STRTAB) + offset); }

  /// The number of symbols, from the hash table of either kind.
  std::size_t symbols() const;

 private:
  const std::uint32_t* hash_table(Elf64_Sxword tag) const {
    return find(tag) != nullptr ? loaded<std::uint32_t>(value(tag), 4) : nullptr;
  }
  const Elf64_Phdr* part(std::uint32_t type) const {
    for (std::size_t i = 0; i < head_.e_phnum; ++i)
      if (parts_[i].p_type == type) return &parts_[i];
    return nullptr;
  }

  const FileBytes& bytes_;
  Elf64_Ehdr& head_;
  const Elf64_Phdr* parts_ = nullptr;
  Elf64_Dyn* entries_ = nullptr;
  std::size_t count_ = 0;
};

}  // namespace waitpoint::posix
