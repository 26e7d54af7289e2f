// SPDX-License-Identifier: BSD-3-Clause
// URW and SURW (Zhao, Wolff, Mathur, Roychoudhury, "Selectively uniform concurrency testing", ASPLOS 2025):
// interleavings are drawn uniformly. A task's chance is proportional to the remaining events of it and of the tasks it
// has yet to create, by the profile; a random walk samples the middle of the space of orders, and hardly its edges.
//
// The selective variant is uniform over the events at one object, drawn for each schedule: the next task there is
// chosen beforehand, and others wait before their event at it.
#pragma once

#include "fibers/explore/strategies/drawn.hpp"

namespace waitpoint::exploration {

class Urw final : public Drawn {
 public:
  explicit Urw(bool selective) : selective_(selective) {}
  std::uint32_t next(const SwitchPoint& at) override;

 private:
  void start(const Profile& profile) override;
  std::uint64_t expected(const Profile::TaskEvents& task) const;
  bool has_met(const Task& task) const { return task.number < ids_.size() && ids_[task.number] != 0; }
  void meet(const Task& task);
  bool counts(const Task& task) const;
  std::uint32_t weighted(const SwitchPoint& at);
  std::uint32_t selected(const SwitchPoint& at);

  bool selective_;
  const Profile* profile_ = nullptr;
  std::uint64_t object_ = 0;              // the object of the selective variant
  std::vector<std::uint64_t> remaining_;  // by Task::number: remaining relevant events, of the task and its future
                                          // descendants
  std::vector<std::uint64_t> ids_;        // by Task::number
  const Task* intended_ = nullptr;        // the next task at the object
  std::vector<std::uint32_t> free_;       // indices of the ready tasks that may run
};

}  // namespace waitpoint::exploration
