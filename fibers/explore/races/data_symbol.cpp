// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/races/data_symbol.hpp"

#include <elf.h>

#include <cstring>
#include <fstream>
#include <vector>

#include "fibers/sync/report/code_place.hpp"

namespace waitpoint::races {
namespace {

class Symbols {
 public:
  explicit Symbols(const std::string& file) : in_(file, std::ios::binary) {}

  std::string at(std::uintptr_t offset) {
    Elf64_Ehdr head{};
    if (!read(0, &head, sizeof head) || std::memcmp(head.e_ident, ELFMAG, SELFMAG) != 0 ||
        head.e_ident[EI_CLASS] != ELFCLASS64)
      return "";
    if (!read_all(head.e_shoff, head.e_shnum, sections_) || !read_all(head.e_phoff, head.e_phnum, parts_)) return "";
    const std::uintptr_t address = offset + start();
    for (const Elf64_Shdr& section : sections_)
      if (section.sh_type == SHT_SYMTAB)
        if (std::string name = in(section, address); !name.empty()) return name;
    return "";
  }

 private:
  bool read(std::uint64_t from, void* to, std::size_t bytes) {
    in_.clear();
    in_.seekg(static_cast<std::streamoff>(from));
    return in_.read(static_cast<char*>(to), static_cast<std::streamsize>(bytes)).good();
  }
  template <class T>
  bool read_all(std::uint64_t from, std::size_t count, std::vector<T>& to) {
    constexpr std::size_t bytes_max = 100'000'000;
    if (count > bytes_max / sizeof(T)) return false;
    to.resize(count);
    return read(from, to.data(), count * sizeof(T));
  }
  // The lowest address of the file, as linked.
  std::uintptr_t start() const {
    for (const Elf64_Phdr& part : parts_)
      if (part.p_type == PT_LOAD) return part.p_vaddr & ~(part.p_align > 1 ? part.p_align - 1 : 0);
    return 0;
  }
  std::string in(const Elf64_Shdr& table, std::uintptr_t address) {
    std::vector<Elf64_Sym> symbols;
    std::vector<char> names;
    if (table.sh_link >= sections_.size()) return "";
    const Elf64_Shdr& of_names = sections_[table.sh_link];
    if (!read_all(table.sh_offset, table.sh_size / sizeof(Elf64_Sym), symbols) ||
        !read_all(of_names.sh_offset, of_names.sh_size, names) || names.empty() || names.back() != '\0')
      return "";
    for (const Elf64_Sym& symbol : symbols) {
      if (ELF64_ST_TYPE(symbol.st_info) != STT_OBJECT || address < symbol.st_value ||
          address - symbol.st_value >= symbol.st_size || symbol.st_name >= names.size())
        continue;
      const std::uintptr_t inside = address - symbol.st_value;
      return sync::demangled(&names[symbol.st_name]) + (inside == 0 ? "" : " + " + std::to_string(inside));
    }
    return "";
  }

  std::ifstream in_;
  std::vector<Elf64_Shdr> sections_;
  std::vector<Elf64_Phdr> parts_;
};

}  // namespace

std::string data_symbol(const std::string& file, std::uintptr_t offset) { return Symbols(file).at(offset); }

}  // namespace waitpoint::races
