// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/search/jobs.hpp"

#include <utility>

#include "tools/command/interruption.hpp"
#include "tools/output/progress.hpp"

namespace waitpoint::tools {

using exploration::EndedSchedule;

Jobs::Jobs(ProcessTarget& target) : target_(target), batches_(target.batch_max(), target.options().shard.count) {}

std::uint32_t Jobs::capacity() const {
  return ended_.empty() && target_.runs().count() < target_.options().jobs ? batches_.size() : 0;
}

void Jobs::start(const Batch& batch) {
  Plan plan{.number = batch.number};
  if (batch.learned != nullptr) plan.constraints = *batch.learned;
  request(batch, plan, {.pairs = batch.learned != nullptr});
}

void Jobs::start(std::uint64_t place, exploration::Enumeration& enumeration) {
  request({.place = place, .number = enumeration.number()}, enumeration.plan(), {.choices = true});
}

bool Jobs::start_rest(std::uint64_t end) {
  const std::optional<Batch> rest = batches_.take_left(end);
  if (rest) start(*rest);
  return rest.has_value();
}

// `plan` is of the first.
void Jobs::request(const Batch& batch, const Plan& plan, const WantedEvidence& wanted) {
  batches_.start(batch, wall_clock_s());
  const ProcessTarget::Repeats repeats{.step = target_.options().shard.count, .count = batch.count - 1};
  target_.runs().start(batch.place, ProcessTarget::to_request(plan, wanted, repeats));
}

void Jobs::take(const Children::Ended& ended) {
  std::vector<Finding> findings = ProcessTarget::findings_of(ended);
  if (!death_of(ended).empty() && batches_.divide(ended.number)) return;
  batches_.end(ended.number, static_cast<std::uint32_t>(findings.size()), wall_clock_s());
  for (std::uint64_t place = ended.number; Finding & finding : findings)
    ended_.push_back({.place = place++, .verdict = finding, .finding = std::make_unique<Finding>(std::move(finding))});
}

EndedSchedule* Jobs::next_ended() {
  if (ended_.empty() && target_.is_at_end()) target_.stop_runs();
  if (ended_.empty())
    if (const auto ended = target_.runs().wait(ProcessTarget::look_around_ms)) take(*ended);
  if (ended_.empty()) return nullptr;
  last_ = std::move(ended_.front());
  ended_.pop_front();
  last_.choices = last_.finding->lesson.choices;
  last_.pairs = last_.finding->lesson.pairs;
  return &last_;
}

void Jobs::kill_from(std::uint64_t place) {
  target_.is_at_end() ? target_.stop_runs() : target_.runs().kill_from(place);
}

bool Jobs::is_interrupted() const { return interruption() != 0; }

}  // namespace waitpoint::tools
