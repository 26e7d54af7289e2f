// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/strategies/profile.hpp"

#include <algorithm>

namespace waitpoint::exploration {
namespace {

// The objects of more than one task, in the order of their first use.
std::vector<std::uint64_t> shared_objects(const Profile& profile) {
  std::vector<std::uint64_t> used, shared;
  for (const Profile::TaskEvents& task : profile.tasks) {
    std::vector<std::uint64_t> own;
    for (const std::uint64_t object : task.objects) {
      if (object == 0 || std::find(own.begin(), own.end(), object) != own.end()) continue;
      own.push_back(object);
      const bool known = std::find(used.begin(), used.end(), object) != used.end();
      if (!known)
        used.push_back(object);
      else if (std::find(shared.begin(), shared.end(), object) == shared.end())
        shared.push_back(object);
    }
  }
  return shared;
}

}  // namespace

void Profile::finish(std::uint32_t switch_points) {
  steps = switch_points;
  shared = shared_objects(*this);
}

Profiling::Profiling(Profile& profile) : profile_(profile) {
  profile_ = Profile();
  event = &Profiling::count;
}

void Profiling::count(kernel::Watch& self, const kernel::EventRecord& record) {
  Profile& profile = static_cast<Profiling&>(self).profile_;
  const kernel::Task& task = *record.task;
  Profile::TaskEvents* known = profile.find(task.id);
  if (known == nullptr) known = &profile.tasks.emplace_back(Profile::TaskEvents{task.id, task.maker, 0, {}});
  ++known->events;
  // Joins do not make a thread's end an object worth reordering.
  const bool meets = record.object != nullptr && record.operation != kernel::Operation::join;
  known->objects.push_back(meets ? record.object->identity : 0);
}

}  // namespace waitpoint::exploration
