// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/body_runs.hpp"

#include "fibers/explore/races/races.hpp"
#include "fibers/explore/strategies/factory.hpp"

namespace waitpoint::exploration {

BodyRuns::BodyRuns(Body& body, const ExploreOptions& options, const Profile& profile, Supervisor& supervisor)
    : body_(body),
      options_(options),
      profile_(profile),
      supervisor_(supervisor),
      drawing_(make_strategy(options.strategy)),
      sampled_(options.strategy) {}

void BodyRuns::start(const Batch& batch) {
  supervisor_.begin(batch.number);
  const bool is_sampled = sampled_.contain(batch.number);
  if (is_sampled) body_.explorer().record(&relation_);
  run(*drawing_, options_.strategy, batch.place, batch.number);
  body_.explorer().record(nullptr);
  ended_.pairs = is_sampled ? std::span<const ReadsFrom>(relation_.pairs()) : std::span<const ReadsFrom>();
  (void)drawing_->end();
}

void BodyRuns::start(std::uint64_t place, Enumeration& enumeration) {
  if (enumeration.number() == 0) races::note_unlearned(true);
  supervisor_.begin(enumeration.number(), enumeration.after_draws());
  run(enumeration.strategy(), enumeration.name(), place, enumeration.number());
  ended_.choices = body_.explorer().schedule().decisions;
}

void BodyRuns::run(Strategy& strategy, const std::string& name, std::uint64_t place, std::uint64_t number) {
  strategy.begin(number, Draws(options_.seed, name, number), profile_);
  ended_.place = place;
  ended_.verdict = body_.run(strategy);
  if (!ended_.verdict.passed()) ended_.finding = std::make_unique<Finding>(finding_of(ended_.verdict));
  has_ended_ = true;
}

Finding BodyRuns::finding_of(const RunVerdict& verdict) {
  Finding finding = body_.finding_of(verdict);
  if (options_.races == Races::report)
    for (const races::Race& race : new_races_.take()) finding.evidence.races.push_back(told(race));
  return finding;
}

}  // namespace waitpoint::exploration
