// SPDX-License-Identifier: BSD-3-Clause
// URW and SURW (Zhao, Wolff, Mathur, Roychoudhury, "Selectively uniform concurrency testing", ASPLOS 2025):
// interleavings are drawn uniformly. A task goes on with a chance in proportion to the events that it and the tasks it
// is yet to make still have, as the profile counts them; a random walk finds the middle of the space of orders, and
// hardly its edges.
//
// The selective one is uniform over the events at one object alone, drawn for each schedule: who is next there is
// decided beforehand, and others wait before theirs.
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
  std::uint64_t object_ = 0;              // at whose events it is selective
  std::vector<std::uint64_t> remaining_;  // by Task::number: events that count, its own and of those to be made
  std::vector<std::uint64_t> ids_;        // by Task::number
  const Task* intended_ = nullptr;        // who is next at the object
  std::vector<std::uint32_t> free_;       // which of the ready may go on
};

}  // namespace waitpoint::exploration
