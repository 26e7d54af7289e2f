// SPDX-License-Identifier: BSD-3-Clause
#include "tools/exec/program_file.hpp"

#include <elf.h>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <algorithm>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string_view>
#include <vector>

#include "core/program_path.hpp"
#include "fibers/posix/base/elf_file.hpp"

namespace waitpoint::tools {
namespace {

template <class T>
bool read_at(std::ifstream& file, std::uint64_t offset, T& value) {
  file.seekg(static_cast<std::streamoff>(offset));
  return static_cast<bool>(file.read(reinterpret_cast<char*>(&value), sizeof value));
}

auto elf_of(std::ifstream& file) {
  return posix::ElfFile([&file](void* to, std::size_t size, std::uint64_t from) {
    file.clear();
    file.seekg(static_cast<std::streamoff>(from));
    return static_cast<bool>(file.read(static_cast<char*>(to), static_cast<std::streamsize>(size)));
  });
}

// At once: a program may have many thousand symbols. Empty if the file does not have all these bytes.
std::string contents_of(std::ifstream& file, const Elf64_Shdr& section) {
  file.clear();
  file.seekg(0, std::ios::end);
  const auto size = static_cast<std::uint64_t>(file.tellg());
  if (section.sh_offset > size || section.sh_size > size - section.sh_offset) return "";
  std::string bytes(section.sh_size, '\0');
  file.seekg(static_cast<std::streamoff>(section.sh_offset));
  return file.read(bytes.data(), static_cast<std::streamsize>(bytes.size())) ? bytes : "";
}

// `is_wanted` is a function: bool (const Elf64_Sym& symbol, std::string_view name).
template <class IsWanted>
bool has_dynamic_symbol(std::ifstream& file, IsWanted is_wanted) {
  Elf64_Ehdr header;
  if (!read_at(file, 0, header) || std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0) return false;
  std::vector<Elf64_Shdr> sections(header.e_shnum);
  for (std::size_t i = 0; i < sections.size(); ++i)
    if (!read_at(file, header.e_shoff + i * sizeof(Elf64_Shdr), sections[i])) return false;
  for (const Elf64_Shdr& section : sections) {
    if (section.sh_type != SHT_DYNSYM || section.sh_link >= sections.size()) continue;
    const std::string symbols = contents_of(file, section), names = contents_of(file, sections[section.sh_link]);
    for (std::size_t at = 0; at + sizeof(Elf64_Sym) <= symbols.size(); at += sizeof(Elf64_Sym)) {
      Elf64_Sym symbol;
      std::memcpy(&symbol, symbols.data() + at, sizeof symbol);
      if (symbol.st_name < names.size() && is_wanted(symbol, std::string_view(names.c_str() + symbol.st_name)))
        return true;
    }
  }
  return false;
}

// A sanitizer's runtime intercepts the same functions, and starts before any preloaded library: g++ links it as a
// library, clang++ into the program. That of g++'s -fsanitize=thread is replaced by an empty one.
std::string trouble_of_sanitizer(std::ifstream& file) {
  if (elf_of(file).needs_library("libasan.so.")) return "is compiled with -fsanitize=address, which must be left out";
  std::string option;
  has_dynamic_symbol(file, [&](const Elf64_Sym& symbol, std::string_view name) {
    if (symbol.st_shndx == SHN_UNDEF) return false;
    if (name == "__tsan_init") option = "thread";
    if (name == "__asan_init") option = "address";
    if (name == "__msan_init") option = "memory";
    return !option.empty();
  });
  if (option == "thread")
    return "contains the runtime of -fsanitize=thread, as clang++ links it: what clang++ has compiled can be linked by "
           "g++ with this option";
  return option.empty() ? "" : "is compiled with -fsanitize=" + option + ", which must be left out";
}

// The dynamic linker, which preloads, is the program's interpreter.
std::string trouble_of_elf(std::ifstream& file) {
  const auto elf = elf_of(file);
  if (!elf.is_known()) return "is not a program for x86-64";
  if (elf.has_part(PT_INTERP)) return trouble_of_sanitizer(file);
  return "is linked statically: nothing can be put in front of its C library";
}

std::string trouble_of_script(std::ifstream& file) {
  std::string line, interpreter;
  file.seekg(2);
  std::getline(file, line);
  std::istringstream(line) >> interpreter;
  if (!is_program(interpreter)) return "is a script whose interpreter '" + interpreter + "' is missing";
  return cannot_be_simulated(interpreter);
}

}  // namespace

// A static position-independent program has no interpreter either, but has a flag that says so.
bool is_shared_object(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const auto elf = elf_of(file);
  return elf.is_known() && elf.head().e_type == ET_DYN && elf.has_part(PT_DYNAMIC) && !elf.has_part(PT_INTERP) &&
         (elf.value(DT_FLAGS_1) & DF_1_PIE) == 0;
}

std::string cannot_be_simulated(const std::filesystem::path& program) {
  struct stat of {};
  if (stat(program.c_str(), &of) == 0 && (of.st_mode & (S_ISUID | S_ISGID)) != 0)
    return "changes its user or group, which disables preloading";
  if (getuid() != 0 && getxattr(program.c_str(), "security.capability", nullptr, 0) > 0)
    return "has capabilities that its user lacks, which disables preloading";
  std::ifstream file(program, std::ios::binary);
  char magic[4] = {};
  if (!file.read(magic, sizeof magic)) return "cannot be read";
  if (std::memcmp(magic, ELFMAG, SELFMAG) == 0) return trouble_of_elf(file);
  if (magic[0] == '#' && magic[1] == '!') return trouble_of_script(file);
  return "is neither a program nor a script";
}

// Looks in the dynamic symbol table; other symbol tables may be stripped.
bool counts_blocks(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return has_dynamic_symbol(file, [](const Elf64_Sym& symbol, std::string_view name) {
    return symbol.st_shndx == SHN_UNDEF && name.starts_with("__sanitizer_cov_trace_pc");
  });
}

std::string interpreter_of(const std::filesystem::path& program) {
  std::ifstream file(program, std::ios::binary);
  Elf64_Phdr part;
  if (!elf_of(file).find_part(part, [](const Elf64_Phdr& one) { return one.p_type == PT_INTERP; })) return "";
  std::string name(std::min<std::uint64_t>(part.p_filesz, PATH_MAX), '\0');
  file.clear();
  file.seekg(static_cast<std::streamoff>(part.p_offset));
  return file.read(name.data(), static_cast<std::streamsize>(name.size())) ? name.c_str() : "";
}

bool needs_library(const std::filesystem::path& path, std::string_view beginning) {
  std::ifstream file(path, std::ios::binary);
  return elf_of(file).needs_library(beginning);
}

// By the number of the call, loaded as the first argument of syscall(), or just before the instruction of that name.
bool waits_by_futexes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  bool calls_by_number = false;
  if (has_dynamic_symbol(file, [&](const Elf64_Sym& symbol, std::string_view name) {
        calls_by_number = calls_by_number || (symbol.st_shndx == SHN_UNDEF && name == "syscall");
        return symbol.st_shndx == SHN_UNDEF && name.starts_with("_ZNSt28__atomic_futex_unsigned_base");
      }))
    return true;
  file.clear();
  file.seekg(0);
  const std::string bytes(std::istreambuf_iterator<char>(file), {});
  constexpr std::string_view argument("\xBF\xCA\0\0\0", 5);  // mov $SYS_futex, %edi
  if (calls_by_number && bytes.find(argument) != std::string::npos) return true;
  constexpr std::string_view number("\xB8\xCA\0\0\0", 5), call("\x0F\x05", 2);  // mov $SYS_futex, %eax; syscall
  constexpr std::size_t nearby = 48;
  for (std::size_t at = bytes.find(number); at != std::string::npos; at = bytes.find(number, at + 1))
    if (std::string_view(bytes).substr(at, nearby).find(call) != std::string_view::npos) return true;
  return false;
}

bool waits_by_calls(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  constexpr std::string_view beginnings[] = {"pthread_mutex_", "pthread_rwlock_",
                                             "pthread_cond_",  "pthread_barrier_",
                                             "pthread_spin_",  "sem_",
                                             "mtx_",           "cnd_"};
  return has_dynamic_symbol(file, [&](const Elf64_Sym& symbol, std::string_view name) {
    const auto begins_name = [name](std::string_view beginning) { return name.starts_with(beginning); };
    return symbol.st_shndx == SHN_UNDEF && std::ranges::any_of(beginnings, begins_name);
  });
}

bool makes_threads(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return has_dynamic_symbol(file, [](const Elf64_Sym& symbol, std::string_view name) {
    return symbol.st_shndx == SHN_UNDEF &&
           (name == "pthread_create" || name == "thrd_create" || name.starts_with("_ZNSt6thread15_M_start_thread"));
  });
}

bool is_instrumented(const std::filesystem::path& program) {
  std::ifstream file(program, std::ios::binary);
  return posix::is_instrumented(elf_of(file));
}

}  // namespace waitpoint::tools
