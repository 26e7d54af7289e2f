// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/members/program_copy.hpp"

#include <elf.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "fibers/posix/base/interposed.hpp"

namespace waitpoint::posix {
namespace {

// A tag unknown to the dynamic linker.
constexpr Elf64_Sxword no_tag = DT_LOOS + 0x5770;
// Programs expect their own descriptors to begin at 3, and rarely reach this one.
constexpr int least_descriptor = 200;
static_assert(sizeof(Elf64_Sym) == 24 && sizeof(Elf64_Rela) == 24 && sizeof(Elf64_Dyn) == 16);
static_assert(no_tag > DT_LOOS && no_tag < DT_HIOS, "the tag is one that systems may define");

// A file's bytes, mapped privately so that they can be changed.
class Bytes {
 public:
  Bytes(const char* file, LoadError& error) {
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
  ~Bytes() {
    if (begin_ != nullptr) munmap(begin_, size_);
  }
  Bytes(const Bytes&) = delete;
  Bytes& operator=(const Bytes&) = delete;

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

class Object {
 public:
  explicit Object(const Bytes& bytes) : bytes_(bytes), head_(*bytes.at<Elf64_Ehdr>(0)) {
    parts_ = bytes.at<Elf64_Phdr>(head_.e_phoff, head_.e_phnum);
  }

  bool is_elf() const {
    return std::memcmp(head_.e_ident, ELFMAG, SELFMAG) == 0 && head_.e_ident[EI_CLASS] == ELFCLASS64 &&
           head_.e_machine == EM_X86_64 && parts_ != nullptr;
  }
  bool is_position_independent() const { return head_.e_type == ET_DYN; }
  bool is_executable() const { return part(PT_INTERP) != nullptr; }

  /// Finds the dynamic section; false without one.
  bool find_dynamic() {
    const Elf64_Phdr* const section = part(PT_DYNAMIC);
    if (section == nullptr) return false;
    count_ = section->p_filesz / sizeof(Elf64_Dyn);
    entries_ = bytes_.at<Elf64_Dyn>(section->p_offset, count_);
    return entries_ != nullptr;
  }
  Elf64_Dyn* find(Elf64_Sxword tag) const {
    for (std::size_t i = 0; i < count_ && entries_[i].d_tag != DT_NULL; ++i)
      if (entries_[i].d_tag == tag) return &entries_[i];
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
  const char* name(const Elf64_Sym& symbol) const { return loaded<char>(value(DT_STRTAB) + symbol.st_name); }

  /// The number of symbols, from the hash table of either kind.
  std::size_t symbols() const {
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

 private:
  const std::uint32_t* hash_table(Elf64_Sxword tag) const {
    return find(tag) != nullptr ? loaded<std::uint32_t>(value(tag), 4) : nullptr;
  }
  const Elf64_Phdr* part(std::uint32_t type) const {
    for (std::size_t i = 0; i < head_.e_phnum; ++i)
      if (parts_[i].p_type == type) return &parts_[i];
    return nullptr;
  }

  const Bytes& bytes_;
  const Elf64_Ehdr& head_;
  const Elf64_Phdr* parts_ = nullptr;
  Elf64_Dyn* entries_ = nullptr;
  std::size_t count_ = 0;
};

void use_own_names_first(Object& object) {
  if (Elf64_Dyn* const flags = object.find(DT_FLAGS); flags != nullptr) {
    flags->d_un.d_val |= DF_SYMBOLIC;
  } else if (Elf64_Dyn* const unused = object.find(no_tag); unused != nullptr) {
    unused->d_tag = DT_SYMBOLIC;
  }
}

// True if the file can be one of several programs, else the reason is in `error`. Constructors and destructors are
// removed from the copy: the layer calls them.
bool change(Object& object, const char* file, ProgramParts& parts, LoadError& error) {
  const auto refused = [&](const char* reason) {
    std::snprintf(error, sizeof error, "%s %s", file, reason);
    return false;
  };
  constexpr char advice[] = "build it with -shared -fPIC";
  if (!object.is_elf()) return refused("is no shared object for x86-64");
  if (!object.is_position_independent() || !object.find_dynamic()) {
    std::snprintf(error, sizeof error, "%s is linked to one address, or statically: %s", file, advice);
    return false;
  }
  if (object.is_executable()) {
    std::snprintf(error, sizeof error, "%s is an executable: %s", file, advice);
    return false;
  }
  for (std::size_t i = 1, count = object.symbols(); i < count; ++i) {
    Elf64_Sym* const symbol = object.symbol(i);
    if (symbol == nullptr) break;
    if (ELF64_ST_BIND(symbol->st_info) == STB_GNU_UNIQUE)
      symbol->st_info = static_cast<unsigned char>(ELF64_ST_INFO(STB_GLOBAL, ELF64_ST_TYPE(symbol->st_info)));
    const char* const name = object.name(*symbol);
    if (symbol->st_shndx != SHN_UNDEF && name != nullptr && std::strcmp(name, "main") == 0)
      parts.main = symbol->st_value;
  }
  if (parts.main == 0) return refused("has no main() that others see");
  parts.initialise = object.take(DT_INIT);
  parts.finish = object.take(DT_FINI);
  parts.constructors = object.take(DT_INIT_ARRAY);
  parts.constructors_bytes = object.take(DT_INIT_ARRAYSZ);
  parts.destructors = object.take(DT_FINI_ARRAY);
  parts.destructors_bytes = object.take(DT_FINI_ARRAYSZ);
  use_own_names_first(object);
  return true;
}

bool write_all(int descriptor, const char* bytes, std::size_t size) {
  for (std::size_t done = 0; done < size;) {
    const ssize_t count = WAITPOINT_NEXT(write)(descriptor, bytes + done, size - done);
    if (count <= 0) return false;
    done += static_cast<std::size_t>(count);
  }
  return true;
}

}  // namespace

int make_copy(const char* file, ProgramParts& parts, LoadError& error) {
  const Bytes bytes(file, error);
  if (!bytes.read()) return -1;
  Object object(bytes);
  if (!change(object, file, parts, error)) return -1;
  const char* const slash = std::strrchr(file, '/');
  const int made = memfd_create(slash != nullptr ? slash + 1 : file, MFD_CLOEXEC);
  const int copy = made < 0 ? -1 : fcntl(made, F_DUPFD_CLOEXEC, least_descriptor);
  if (made >= 0) WAITPOINT_NEXT(close)(made);
  if (copy >= 0 && write_all(copy, bytes.begin(), bytes.size())) return copy;
  std::snprintf(error, sizeof error, "%s cannot be copied: %s", file, std::strerror(errno));
  if (copy >= 0) WAITPOINT_NEXT(close)(copy);
  return -1;
}

}  // namespace waitpoint::posix
