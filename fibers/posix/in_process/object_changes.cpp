// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/in_process/object_changes.hpp"

#include <sys/mman.h>

#include <cstring>

namespace waitpoint::posix {

void take_parts(ObjectFile& object, ProgramParts& parts) {
  for (std::size_t i = 1, count = object.symbols(); i < count; ++i) {
    Elf64_Sym* const symbol = object.symbol(i);
    if (symbol == nullptr) break;
    if (ELF64_ST_BIND(symbol->st_info) == STB_GNU_UNIQUE)
      symbol->st_info = static_cast<unsigned char>(ELF64_ST_INFO(STB_GLOBAL, ELF64_ST_TYPE(symbol->st_info)));
    const char* const name = object.text(symbol->st_name);
    if (symbol->st_shndx != SHN_UNDEF && name != nullptr && std::strcmp(name, "main") == 0)
      parts.main = symbol->st_value;
  }
  parts.initialise = object.take(DT_INIT);
  parts.finish = object.take(DT_FINI);
  parts.constructors = object.take(DT_INIT_ARRAY);
  parts.constructors_bytes = object.take(DT_INIT_ARRAYSZ);
  parts.destructors = object.take(DT_FINI_ARRAY);
  parts.destructors_bytes = object.take(DT_FINI_ARRAYSZ);
  parts.relocations = object.value(DT_RELA);
  parts.relocations_bytes = object.value(DT_RELASZ);
  parts.symbols = object.value(DT_SYMTAB);
  parts.strings = object.value(DT_STRTAB);
  for (const Elf64_Phdr& part : object.parts())
    if (part.p_type == PT_GNU_RELRO)
      parts.protected_begin = part.p_vaddr, parts.protected_end = part.p_vaddr + part.p_memsz;
  object.take(DT_SONAME);
  if (Elf64_Dyn* const flags = object.find(DT_FLAGS_1); flags != nullptr)
    flags->d_un.d_val &= ~std::uint64_t{DF_1_NODELETE};
}

bool is_allocator(const char* file) {
  LoadError ignored;
  const FileBytes bytes(file, ignored);
  if (!bytes.read()) return false;
  ObjectFile object(bytes);
  if (!object.is_elf() || !object.find_dynamic()) return false;
  for (std::size_t i = 1, count = object.symbols(); i < count; ++i) {
    const Elf64_Sym* const symbol = object.symbol(i);
    const char* const name = symbol != nullptr ? object.text(symbol->st_name) : nullptr;
    if (name != nullptr && symbol->st_shndx != SHN_UNDEF && std::strcmp(name, "malloc") == 0) return true;
  }
  return false;
}

namespace {

bool is_environ(const char* name) {
  for (const char* const each : {"environ", "__environ", "_environ"})
    if (std::strcmp(name, each) == 0) return true;
  return false;
}

}  // namespace

void redirect_environ(char* base, const ProgramParts& parts, char*** to) {
  const auto* const symbols = reinterpret_cast<const Elf64_Sym*>(base + parts.symbols);
  const auto* const all = reinterpret_cast<const Elf64_Rela*>(base + parts.relocations);
  for (const Elf64_Rela& one : std::span(all, parts.relocations_bytes / sizeof(Elf64_Rela))) {
    const std::uint64_t type = ELF64_R_TYPE(one.r_info);
    const Elf64_Sym& symbol = symbols[ELF64_R_SYM(one.r_info)];
    if ((type != R_X86_64_GLOB_DAT && type != R_X86_64_64) || symbol.st_shndx != SHN_UNDEF ||
        !is_environ(base + parts.strings + symbol.st_name))
      continue;
    const bool is_protected = one.r_offset >= parts.protected_begin && one.r_offset < parts.protected_end;
    constexpr std::uintptr_t page = 4096;
    auto* const place = base + one.r_offset;
    auto* const begin = place - reinterpret_cast<std::uintptr_t>(place) % page;
    if (is_protected) mprotect(begin, page, PROT_READ | PROT_WRITE);
    std::memcpy(place, &to, sizeof to);
    if (is_protected) mprotect(begin, page, PROT_READ);
  }
}

void rename_in_versions(ObjectFile& object, const char* name, std::uint64_t to) {
  std::uint64_t at = object.value(DT_VERNEED);
  for (std::uint64_t left = object.value(DT_VERNEEDNUM); left > 0; --left) {
    auto* const needed = object.loaded<Elf64_Verneed>(at);
    const char* const file = needed != nullptr ? object.text(needed->vn_file) : nullptr;
    if (file == nullptr) return;
    if (std::strcmp(file, name) == 0) needed->vn_file = static_cast<Elf64_Word>(to);
    at += needed->vn_next;
  }
}

void hide_versions(ObjectFile& object) {
  for (Elf64_Shdr& section : object.sections())
    if (section.sh_type == SHT_GNU_verneed || section.sh_type == SHT_GNU_versym || section.sh_type == SHT_GNU_verdef)
      section.sh_type = SHT_PROGBITS;
}

void add_need(ObjectFile& object, std::uint64_t name) {
  Elf64_Dyn* const unused = object.find(ObjectFile::no_tag);
  if (unused != nullptr) *unused = {DT_NEEDED, {name}};
}

}  // namespace waitpoint::posix
