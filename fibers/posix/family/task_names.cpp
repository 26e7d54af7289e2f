// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/family/task_names.hpp"

#include "fibers/posix/family/family.hpp"
#include "fibers/posix/program/thread.hpp"

namespace waitpoint::posix {

void add_name(BoundedText& text, const kernel::Task& task) {
  const bool is_one_of_several = family::family != nullptr && family::family->made > 1;
  if (is_thread(task) && (thread_of(task).program->is_loaded || is_one_of_several)) text.add("%s: ", task.robot->name);
  text.add("%s", task.name);
}

}  // namespace waitpoint::posix
