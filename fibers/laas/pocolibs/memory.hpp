// SPDX-License-Identifier: BSD-3-Clause
// The blocks of memory that a robot's programs own: zeroed, and freed with the run if the programs do not.
#pragma once

#include <cstddef>
#include <memory>
#include <unordered_map>

#include "fibers/sync/blocking.hpp"
#include "fibers/sync/robot_state.hpp"

namespace waitpoint::laas {

class Memory : public sync::RobotState {
 public:
  explicit Memory(kernel::Robot&) {}
  static Memory& here() { return sync::state_of<Memory>(*sync::running_task().robot); }

  void* allocate(std::size_t bytes) {
    auto made = std::make_unique<std::byte[]>(bytes);  // zeroed
    void* const block = made.get();
    blocks_[block] = {std::move(made), bytes};
    return block;
  }
  bool owns(const void* block) const { return blocks_.contains(block); }
  /// Of a block that it owns.
  std::size_t size_of(const void* block) const { return blocks_.at(block).size; }
  void release(const void* block) { blocks_.erase(block); }

 private:
  struct Block {
    std::unique_ptr<std::byte[]> bytes;
    std::size_t size = 0;
  };
  std::unordered_map<const void*, Block> blocks_;  // looked up, never walked: addresses differ between runs
};

}  // namespace waitpoint::laas
