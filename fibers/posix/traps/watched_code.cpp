// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/traps/watched_code.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <link.h>
#include <sys/stat.h>
#include <sys/syscall.h>

#include <algorithm>
#include <cstring>

#include "core/error.hpp"
#include "fibers/posix/base/direct_call.hpp"

namespace waitpoint::posix {
namespace {

bool has_writable_code(const dl_phdr_info& module) {
  constexpr unsigned both = PF_W | PF_X;
  return std::any_of(module.dlpi_phdr, module.dlpi_phdr + module.dlpi_phnum,
                     [](const ElfW(Phdr) & part) { return part.p_type == PT_LOAD && (part.p_flags & both) == both; });
}

bool is_file(const char* name, const AccessLibrary& library) {
  struct stat of {};
  return name[0] != '\0' &&
         call_directly(SYS_newfstatat, AT_FDCWD, reinterpret_cast<long>(name), reinterpret_cast<long>(&of), 0) == 0 &&
         of.st_dev == library.device && of.st_ino == library.inode;
}

}  // namespace

void WatchedCode::watch(std::span<const AccessInstruction> instructions, std::span<const AccessLibrary> libraries) {
  WAITPOINT_CHECK(libraries.size() < modules_max, "too many libraries have breakpoints");
  instructions_ = instructions;
  libraries_ = libraries;
  count_ = libraries.size() + 1;
  for (std::size_t i = 0; i < count_; ++i) {
    Module& module = modules_[i] = {};
    const auto all = std::ranges::equal_range(instructions, i, {}, &AccessInstruction::module);
    module.begin = static_cast<std::size_t>(all.begin() - instructions.begin());
    module.end = module.begin + all.size();
  }
}

WatchedCode::Found WatchedCode::take(Module& module, std::uint64_t loaded_at) {
  module.loaded_at = loaded_at;
  const auto all = instructions_.subspan(module.begin, module.end - module.begin);
  for (const AccessInstruction& one : all)
    if (std::memcmp(reinterpret_cast<const void*>(loaded_at + one.offset()), one.code, one.length) != 0)
      return Found::changed;
  if (!module.copies.make(all, loaded_at)) return Found::no_memory;
  module.is_loaded = true;
  module.low = loaded_at + all.front().offset();
  module.high = loaded_at + all.back().offset();
  return Found::good;
}

// A library must not be unloaded together with its breakpoints.
void WatchedCode::keep_loaded(Module& module) {
  if (!module.is_loaded || module.is_kept) return;
  module.is_kept = true;
  (void)dlopen(module.name, RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE);
}

/// A walk over all that is loaded, the program first.
struct WatchedCode::Search {
  WatchedCode& code;
  std::size_t seen = 0;
  Found found = Found::good;

  Module* module_of(const dl_phdr_info& loaded) {
    if (seen++ == 0) return code.modules_.data();
    for (std::size_t i = 1; i < code.count_; ++i)
      if (!code.modules_[i].is_loaded && is_file(loaded.dlpi_name, code.libraries_[i - 1])) return &code.modules_[i];
    return nullptr;
  }

  static int look(dl_phdr_info* loaded, std::size_t, void* search) {
    auto& [code, seen, found] = *static_cast<Search*>(search);
    Module* const module = static_cast<Search*>(search)->module_of(*loaded);
    if (module == nullptr || module->is_loaded || module->begin == module->end) return code.are_all_loaded() ? 1 : 0;
    module->range = range_of_loaded(*loaded);
    module->name = loaded->dlpi_name;
    found = has_writable_code(*loaded) ? Found::changed : code.take(*module, loaded->dlpi_addr);
    return found != Found::good || code.are_all_loaded() ? 1 : 0;
  }
};

WatchedCode::Found WatchedCode::find_loaded() {
  Search search{*this};
  dl_iterate_phdr(Search::look, &search);
  for (std::size_t i = 1; i < count_; ++i) keep_loaded(modules_[i]);
  return search.found;
}

std::uint64_t WatchedCode::loaded() const {
  std::uint64_t bits = 0;
  for (std::size_t i = 1; i < count_; ++i) bits |= std::uint64_t{modules_[i].is_loaded} << (i - 1);
  return bits;
}

bool WatchedCode::are_all_loaded() const {
  return std::all_of(modules_.begin(), modules_.begin() + count_,
                     [](const Module& module) { return module.is_loaded || module.begin == module.end; });
}

void WatchedCode::leave() {
  for (std::size_t i = 0; i < count_; ++i) {
    modules_[i].copies.remove();
    modules_[i].is_loaded = false;
  }
}

std::size_t WatchedCode::from(const Module& module, std::uint64_t address) const {
  const auto all = instructions_.subspan(module.begin, module.end - module.begin);
  const auto found = std::ranges::lower_bound(all, address - module.loaded_at, {}, &AccessInstruction::offset);
  return module.begin + static_cast<std::size_t>(found - all.begin());
}

std::size_t WatchedCode::number_at(std::uint64_t address) const {
  for (std::size_t i = 0; i < count_; ++i) {
    const Module& module = modules_[i];
    if (!module.is_loaded || address < module.low || address > module.high) continue;
    const std::size_t found = from(module, address);
    return address_of(found) == address ? found : size();
  }
  return size();
}

bool WatchedCode::has_within(std::uint64_t address, std::uint64_t bytes) const {
  for (std::size_t i = 0; i < count_; ++i) {
    const Module& module = modules_[i];
    if (!module.is_loaded || address > module.high || address + bytes <= module.low) continue;
    if (address_of(from(module, std::max(address, module.low))) < address + bytes) return true;
  }
  return false;
}

std::uint64_t WatchedCode::original_of(std::uint64_t place) const {
  for (std::size_t i = 0; i < count_; ++i)
    if (const std::uint64_t original = modules_[i].copies.original_of(place); original != place) return original;
  return place;
}

bool WatchedCode::contains(const void* address) const {
  return std::any_of(modules_.begin(), modules_.begin() + count_, [address](const Module& module) {
    return module.is_loaded && module.range.contains(reinterpret_cast<std::uintptr_t>(address));
  });
}

}  // namespace waitpoint::posix
