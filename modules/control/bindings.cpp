// SPDX-License-Identifier: BSD-3-Clause
#include "modules/control/bindings.hpp"

#include <algorithm>
#include <cmath>

#include "core/nearest_name.hpp"

namespace waitpoint::control {
namespace {

using Kind = Predicate::Kind;

template <class Entries>
std::string hint(const std::string& word, const Entries& entries) {
  std::vector<std::string_view> known;
  known.reserve(entries.size());
  for (const auto& [name, entry] : entries) known.push_back(name);
  return did_you_mean(word, known);
}

bool meets(const RequestPattern& pattern, const genom::Payload& input) {
  return std::all_of(pattern.inputs.begin(), pattern.inputs.end(), [&](const Comparison& comparison) {
    double value = 0;
    return input.read(comparison.path, value) == FieldOutcome::number &&
           holds(comparison.relation, value, comparison.number);
  });
}

/// The value of a predicate about a poster that is given.
bool value_of(const Predicate& predicate, const FieldReading* reading, Duration age) {
  if (predicate.kind == Kind::given) return true;
  if (predicate.kind == Kind::aged) return age > predicate.time;
  if (reading->outcome != FieldOutcome::number || std::isnan(reading->number)) return false;
  if (predicate.kind == Kind::present) return true;
  return predicate.kind == Kind::greater ? reading->number > predicate.number : reading->number >= predicate.number;
}

constexpr std::size_t no_reading = static_cast<std::size_t>(-1);

}  // namespace

Bindings::Bindings(const Rules& rules, const Automaton& automaton, const genom::NameSpace& names)
    : rules_(rules), automaton_(automaton) {
  for (const RequestPattern& pattern : automaton.patterns()) bind(pattern, names);
  for (const Check& check : rules.checks)
    for (const RequestPattern& pattern : check.interrupted) expect_activity(pattern);
  for (std::size_t v = 0; v < automaton.predicates().size(); ++v)
    if (!automaton.predicates()[v].poster.empty()) bind(v, names);
}

void Bindings::bind(const RequestPattern& pattern, const genom::NameSpace& names) {
  const genom::Module* const module = names.find_module(pattern.module);
  if (module == nullptr)
    throw bad(rules_.file, pattern.place,
              "there is no module '" + pattern.module + "'" + hint(pattern.module, names.modules()));
  const genom::RequestType* const type = module->find_request(pattern.request);
  if (type == nullptr) {
    std::vector<std::string_view> known;
    for (const genom::RequestType& each : module->requests()) known.push_back(each.name);
    throw bad(rules_.file, pattern.place,
              "module '" + pattern.module + "' has no request '" + pattern.request + "'" +
                  did_you_mean(pattern.request, known));
  }
  if (type->name == "Abort")
    throw bad(rules_.file, pattern.place, "expected a request other than Abort, which is always accepted");
  for (const Comparison& input : pattern.inputs)
    if (!type->has_input(input.path))
      throw bad(rules_.file, input.place,
                "the input of " + request_name(pattern) + " has no number '" + input.path + "'");
  requests_.push_back({module, type->number});
}

void Bindings::expect_activity(const RequestPattern& pattern) const {
  const Request& request = requests_[automaton_.index_of(pattern)];
  if (request.module->requests()[request.number].kind == genom::RequestKind::control)
    throw bad(rules_.file, pattern.place,
              "expected an activity to interrupt: " + request_name(pattern) + " is a control request");
}

void Bindings::bind(std::size_t variable, const genom::NameSpace& names) {
  const Predicate& predicate = automaton_.predicates()[variable];
  genom::PosterBase* const poster = names.find_poster(predicate.poster);
  if (poster == nullptr)
    throw bad(rules_.file, predicate.place,
              "there is no poster '" + predicate.poster + "'" + hint(predicate.poster, names.posters()));
  if (!predicate.path.empty() && !poster->has_number(predicate.path))
    throw bad(rules_.file, predicate.place, "poster '" + predicate.poster + "' has no number '" + predicate.path + "'");
  auto read =
      std::find_if(posters_.begin(), posters_.end(), [&](const ReadPoster& each) { return each.poster == poster; });
  if (read == posters_.end()) read = posters_.insert(read, {poster, {}, {}, {}});
  read->predicates.push_back(variable);
  if (predicate.path.empty()) return read->reading_of.push_back(no_reading);
  const auto known = std::find_if(read->readings.begin(), read->readings.end(),
                                  [&](const FieldReading& each) { return each.path == predicate.path; });
  read->reading_of.push_back(static_cast<std::size_t>(known - read->readings.begin()));
  if (known == read->readings.end()) read->readings.push_back({.path = predicate.path});
}

std::vector<std::size_t> Bindings::patterns_of(const genom::Module& module, const genom::Letter& request) const {
  std::vector<std::size_t> patterns;
  for (std::size_t p = 0; p < requests_.size(); ++p)
    if (requests_[p].module == &module && requests_[p].number == request.request &&
        meets(automaton_.patterns()[p], request.payload))
      patterns.push_back(p);
  return patterns;
}

void Bindings::observe(std::vector<bool>& values) {
  for (ReadPoster& read : posters_) {
    Time date;
    const bool is_given = read.poster->read_numbers(read.readings, date) == genom::PosterStatus::ok;
    threads::access_hardware(read.poster->latency());
    const Duration age = is_given ? threads::now() - date : Duration();
    for (std::size_t i = 0; i < read.predicates.size(); ++i) {
      const Predicate& predicate = automaton_.predicates()[read.predicates[i]];
      const std::size_t reading = read.reading_of[i];
      values[read.predicates[i]] =
          is_given ? value_of(predicate, reading == no_reading ? nullptr : &read.readings[reading], age)
                   : predicate.kind == Kind::aged;
    }
  }
}

}  // namespace waitpoint::control
