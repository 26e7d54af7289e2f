// SPDX-License-Identifier: BSD-3-Clause
#include "modules/plan/plan_network.hpp"

#include <algorithm>

#include "core/number_text.hpp"

namespace waitpoint::plan {
namespace {

/// Of constraints that are refused or taken back, in the search of an order.
constexpr int order_tries_max = 1000;

/// The order of actions at one resource.
class ResourceOrder {
 public:
  ResourceOrder(const TemporalPlan& plan, std::vector<std::size_t> actions, std::size_t resource,
                TemporalNetwork& network)
      : plan_(plan), actions_(std::move(actions)), resource_(resource), network_(network) {}

  /// Adds constraints "end of the first to start of the second" to the network until no overlap is possible that needs
  /// more than the capacity; false if there is no such order, or none is found in time.
  bool find() {
    std::vector<Choice> choices;
    for (std::vector<std::size_t> set = overlap(); !set.empty(); set = overlap()) {
      choices.push_back({std::move(set), 0, network_.mark()});
      while (!choose(choices.back())) {
        choices.pop_back();
        if (choices.empty() || tries_ == order_tries_max) return false;
        ++tries_;
        pairs_.pop_back();
        network_.roll_back(choices.back().mark);
      }
    }
    return true;
  }
  /// Of find(): an order may exist all the same.
  bool gave_up() const { return tries_ == order_tries_max; }

  const std::vector<std::pair<std::size_t, std::size_t>>& pairs() const { return pairs_; }

 private:
  /// Actions that may not all overlap, and the pairs of them, numbered, of which one has yet to be tried.
  struct Choice {
    std::vector<std::size_t> set;
    std::size_t next_pair;
    std::size_t mark;  ///< of the network without the choice
  };

  // Adds the next pair that the network allows; false if none is left, or after too many tries.
  bool choose(Choice& choice) {
    const std::size_t size = choice.set.size();
    while (choice.next_pair < size * size && tries_ < order_tries_max) {
      const std::size_t first = choice.set[choice.next_pair / size], second = choice.set[choice.next_pair % size];
      ++choice.next_pair;
      if (first == second) continue;
      if (network_.add({start_of(second), end_of(first), Duration(), 0})) {
        pairs_.emplace_back(first, second);
        return true;
      }
      ++tries_;
    }
    return false;
  }

  std::uint32_t amount(std::size_t action) const {
    for (const Use& use : plan_.actions[action].uses)
      if (use.resource == resource_) return use.amount;
    return 0;
  }
  // True if the constraints do not forbid it.
  bool may_overlap(std::size_t a, std::size_t b) const {
    return network_.distance(start_of(b), end_of(a)) > Duration() &&
           network_.distance(start_of(a), end_of(b)) > Duration();
  }
  // The first actions, in the order of the file, that may all overlap and need too much.
  std::vector<std::size_t> overlap() const {
    for (const std::size_t first : actions_) {
      std::vector<std::size_t> set{first};
      std::uint64_t sum = amount(first);
      for (const std::size_t next : actions_) {
        if (next <= first || !std::all_of(set.begin(), set.end(), [&](auto other) { return may_overlap(other, next); }))
          continue;
        set.push_back(next);
        sum += amount(next);
        if (sum > plan_.resources[resource_].capacity) return set;
      }
    }
    return {};
  }

  const TemporalPlan& plan_;
  std::vector<std::size_t> actions_;
  std::size_t resource_;
  TemporalNetwork& network_;
  std::vector<std::pair<std::size_t, std::size_t>> pairs_;
  int tries_ = 0;  // constraints that were refused, or taken back
};

}  // namespace

Situation::Situation(const TemporalPlan& plan)
    : branch(plan.alternatives.size()), times(plan.points()), loosened(plan.actions.size()) {
  times[origin] = Duration();
}

bool Situation::is_active(const TemporalPlan& plan, std::size_t action) const {
  const Action& of = plan.actions[action];
  return !of.alternative || branch[*of.alternative] == of.branch;
}

PlanNetwork::PlanNetwork(const TemporalPlan& plan, const Situation& situation) {
  network_.points = plan.points();
  network_.natural.assign(network_.points, false);
  label("the order of time", {});
  for (std::size_t i = 0; i < plan.actions.size(); ++i)
    if (situation.is_active(plan, i)) add_action(plan, situation, i);
  for (const Constraint& constraint : plan.constraints) {
    const auto is_there = [&](PointId point) { return point == origin || situation.is_active(plan, action_of(point)); };
    if (!is_there(constraint.from) || !is_there(constraint.to)) continue;
    const std::uint32_t own = label(constraint.name, constraint.written);
    if (constraint.most) network_.edges.push_back({constraint.from, constraint.to, *constraint.most, own});
    if (constraint.least) network_.edges.push_back({constraint.to, constraint.from, -*constraint.least, own});
  }
  for (PointId point = 1; point < network_.points; ++point) {
    if (!situation.times[point] || !situation.is_active(plan, action_of(point))) continue;
    network_.edges.push_back({origin, point, *situation.times[point], 0});
    network_.edges.push_back({point, origin, -*situation.times[point], 0});
  }
  add_resources(plan, situation);
}

std::uint32_t PlanNetwork::label(std::string name, const scenario::Location& written) {
  labels_.push_back({std::move(name), written});
  return static_cast<std::uint32_t>(labels_.size() - 1);
}

void PlanNetwork::add_action(const TemporalPlan& plan, const Situation& situation, std::size_t i) {
  const Action& action = plan.actions[i];
  const PointId start = start_of(i), end = end_of(i);
  const std::uint32_t own = label("duration of " + action.name, action.written);
  network_.edges.push_back({start, origin, situation.times[start] ? Duration() : -situation.now, 0});
  network_.natural[end] = action.contingent;
  if (situation.loosened[i]) {
    network_.edges.push_back({end, start, Duration(), own});
    if (!situation.times[end]) network_.edges.push_back({end, origin, -situation.now, 0});
  } else if (action.contingent && !situation.times[end]) {
    const Duration elapsed = situation.times[start] ? situation.now - *situation.times[start] : Duration();
    network_.links.push_back({start, end, std::min(std::max(action.least, elapsed), action.most), action.most, own});
  } else {
    network_.edges.push_back({end, start, -action.least, own});
    if (action.most < bound_max) network_.edges.push_back({start, end, action.most, own});
  }
}

void PlanNetwork::add_resources(const TemporalPlan& plan, const Situation& situation) {
  if (plan.resources.empty()) return;
  TemporalNetwork trial(network_.points);
  for (const Edge& edge : network_.edges)
    if (!trial.add(edge)) return;  // the dispatcher tells of it
  for (const ContingentLink& link : network_.links)
    if (!trial.add({link.start, link.end, link.most, 0}) || !trial.add({link.end, link.start, -link.least, 0})) return;
  for (std::size_t resource = 0; resource < plan.resources.size(); ++resource) {
    std::vector<std::size_t> users;
    for (std::size_t i = 0; i < plan.actions.size(); ++i)
      if (situation.is_active(plan, i) && std::any_of(plan.actions[i].uses.begin(), plan.actions[i].uses.end(),
                                                      [&](const Use& use) { return use.resource == resource; }))
        users.push_back(i);
    ResourceOrder order(plan, users, resource, trial);
    const std::uint32_t own = label("resource " + plan.resources[resource].name, plan.resources[resource].written);
    if (!order.find()) {
      // A contradiction under the resource's name.
      if (order.gave_up()) unordered_ = resource;
      network_.edges.push_back({origin, start_of(users.front()), Duration::from_ns(-1), own});
      return;
    }
    for (const auto& [first, second] : order.pairs())
      network_.edges.push_back({start_of(second), end_of(first), Duration(), own});
  }
}

std::string PlanNetwork::conflict_text(const std::vector<std::uint32_t>& labels) const {
  std::string text;
  std::vector<std::uint32_t> seen;
  for (const std::uint32_t label : labels) {
    if (label == 0 || std::find(seen.begin(), seen.end(), label) != seen.end()) continue;
    seen.push_back(label);
    text += (text.empty() ? "'" : ", '") + labels_[label].name + "' (line " +
            std::to_string(labels_[label].written.line) + ")";
  }
  return text;
}

const scenario::Location& PlanNetwork::place(const std::vector<std::uint32_t>& labels) const {
  const auto first = std::find_if(labels.begin(), labels.end(), [](std::uint32_t label) { return label != 0; });
  WAITPOINT_CHECK(first != labels.end(), "the order of time contradicts itself");
  return labels_[*first].written;
}

PlanCheck check(const TemporalPlan& plan) {
  PlanCheck result;
  const auto look = [&](const Situation& situation, bool is_first) {
    const PlanNetwork of(plan, situation);
    if (const std::optional<std::size_t> unordered = of.unordered()) {
      const Resource& resource = plan.resources[*unordered];
      throw resource.written.bad("no order of the actions at resource '" + resource.name + "' was found in " +
                                 std::to_string(order_tries_max) + " tries, expected parts of it as 'after'");
    }
    const Dispatcher dispatcher(of.network());
    if (!dispatcher.consistent())
      throw of.place(dispatcher.conflict())
          .bad("expected a consistent plan, found a cycle of constraints that contradict each other: " +
               of.conflict_text(dispatcher.conflict()));
    if (is_first) {
      result.points = 1;
      for (std::size_t i = 0; i < plan.actions.size(); ++i) result.points += situation.is_active(plan, i) ? 2 : 0;
      result.constraints = of.network().edges.size() + 2 * of.network().links.size();
    }
    if (dispatcher.controllability().controllable || !result.controllable) return;
    result.controllable = false;
    result.conflict = of.conflict_text(dispatcher.controllability().conflict);
  };
  Situation situation(plan);
  look(situation, true);
  for (std::size_t i = 0; i < plan.alternatives.size(); ++i, situation = Situation(plan))
    for (situation.branch[i] = 1; situation.branch[i] < plan.alternatives[i].branches; ++situation.branch[i])
      look(situation, false);
  return result;
}

std::string to_string(const PlanCheck& check) {
  return counted(check.points, "time point") + ", " + counted(check.constraints, "constraint") + ": consistent, " +
         (check.controllable ? "dynamically controllable" : "NOT dynamically controllable, by " + check.conflict);
}

}  // namespace waitpoint::plan
