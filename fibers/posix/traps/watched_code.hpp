// SPDX-License-Identifier: BSD-3-Clause
// The code in which breakpoints are set: the program's, and that of its libraries as they are loaded.
//
//   instructions  | of the program ...... | of library 1 .. | of library 2 ... |   by their places; numbered from 0 on
//   modules       | begin, loaded_at, copies | likewise     | not loaded       |
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "fibers/posix/traps/access_instruction.hpp"
#include "fibers/posix/traps/instruction_copies.hpp"
#include "fibers/posix/traps/library_range.hpp"

namespace waitpoint::posix {

class WatchedCode {
 public:
  static constexpr std::size_t modules_max = 64;

  /// Both must stay; the instructions in the order of their places, of at most `modules_max` modules.
  void watch(std::span<const AccessInstruction> instructions, std::span<const AccessLibrary> libraries);

  enum class Found : std::uint8_t { good, changed, no_memory };
  /// Looks for modules that have been loaded since. `changed`: code is not that of its file, or is writable.
  Found find_loaded();
  /// The libraries that are loaded: a bit for each, the lowest for the first.
  std::uint64_t loaded() const;
  /// False if a module with instructions is still missing.
  bool are_all_loaded() const;
  /// Removes the copies.
  void leave();

  std::size_t size() const { return instructions_.size(); }
  const AccessInstruction& operator[](std::size_t i) const { return instructions_[i]; }
  bool is_loaded(std::size_t i) const { return module_of(i).is_loaded; }
  /// The instruction in memory; of a loaded module.
  std::uint8_t* at(std::size_t i) const { return reinterpret_cast<std::uint8_t*>(address_of(i)); }
  std::uint64_t address_of(std::size_t i) const { return loaded_at(i) + instructions_[i].offset(); }
  std::uint64_t loaded_at(std::size_t i) const { return module_of(i).loaded_at; }
  /// Where it is executed in place of the original.
  std::uint64_t copy_of(std::size_t i) const { return module_of(i).copies.of(i - module_of(i).begin); }

  /// The number of the instruction at this address, in a module that is loaded; size() if there is none.
  std::size_t number_at(std::uint64_t address) const;
  /// True if an instruction begins in these bytes.
  bool has_within(std::uint64_t address, std::uint64_t bytes) const;
  /// For a place within the copies, that in the code where execution is; any other remains.
  std::uint64_t original_of(std::uint64_t place) const;
  /// True for an address in a loaded module.
  bool contains(const void* address) const;

 private:
  struct Module {
    std::size_t begin = 0, end = 0;  // of its instructions
    bool is_loaded = false;
    bool is_kept = false;
    std::uint64_t loaded_at = 0;
    std::uint64_t low = 0, high = 0;  // the addresses of its first and last instruction
    LibraryRange range{};
    const char* name = nullptr;
    InstructionCopies copies;
  };
  struct Search;

  const Module& module_of(std::size_t i) const { return modules_[instructions_[i].module()]; }
  std::size_t from(const Module& module, std::uint64_t address) const;
  static void keep_loaded(Module& module);
  Found take(Module& module, std::uint64_t loaded_at);

  std::span<const AccessInstruction> instructions_;
  std::span<const AccessLibrary> libraries_;
  std::array<Module, modules_max> modules_{};
  std::size_t count_ = 0;
};

}  // namespace waitpoint::posix
