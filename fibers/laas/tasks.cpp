// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/laas/tasks.hpp"

#include "fibers/laas/h2semLib.hpp"

namespace waitpoint::laas {

TaskControlBlock& Tasks::make() {
  const long id = ++made_;
  return by_id_.try_emplace(id, id).first->second;
}

TaskControlBlock& Tasks::self() {
  const auto found = by_task_.find(sync::running_task().id);
  if (found != by_task_.end()) return *found->second;
  TaskControlBlock& block = make();
  block.name = sync::running_task().name;
  adopt(block);
  return block;
}

TaskControlBlock* Tasks::find(long id) {
  if (id == 0) return &self();
  const auto found = by_id_.find(id);
  return found == by_id_.end() ? nullptr : &found->second;
}

TaskControlBlock* Tasks::find(const std::string& name) {
  for (auto& [id, block] : by_id_)
    if (block.name == name) return &block;
  return nullptr;
}

void Tasks::end() {
  const auto found = by_task_.find(sync::running_task().id);
  TaskControlBlock& block = *found->second;
  if (block.events != 0) h2semDelete(block.events);
  by_task_.erase(found);
  by_id_.erase(block.id);
}

int errnoGet() { return Tasks::here().self().error; }

STATUS errnoSet(int error) {
  Tasks::here().self().error = error;
  return OK;
}

STATUS fail(int error) {
  errnoSet(error);
  return ERROR;
}

}  // namespace waitpoint::laas
