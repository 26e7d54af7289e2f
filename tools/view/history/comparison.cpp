// SPDX-License-Identifier: BSD-3-Clause
#include "tools/view/history/comparison.hpp"

#include <algorithm>
#include <limits>

#include "fibers/kernel/operation.hpp"

namespace waitpoint::tools::view {
namespace {

constexpr std::int64_t parts = 16;
constexpr Duration part_least = std::chrono::milliseconds(20);
constexpr std::size_t events_compared = 200'000;

/// An event of the columns in words: "ndd.motion of rackham: lock mutex#40".
std::string words(const Json& events, std::size_t i) {
  const Json& task = events["tasks"][events["k"][i].get<std::size_t>()];
  std::string text = task[1].get<std::string>() + " of " + task[2].get<std::string>() + ": " +
                     kernel::name(static_cast<kernel::Operation>(events["o"][i].get<int>()));
  const auto object = events["x"][i].get<std::int64_t>();
  if (object < 0) return text;
  const Json& of = events["objects"][static_cast<std::size_t>(object)];
  return text + " " + of[0].get<std::string>() + "#" + std::to_string(of[1].get<std::uint64_t>());
}

}  // namespace

void Comparison::begin(History::Reply reply) {
  reply_ = std::move(reply);
  compare_digests();
}

void Comparison::ask_both(const Json& request, const std::function<void(const std::array<std::string, 2>&)>& use) {
  const auto replies = std::make_shared<std::array<std::string, 2>>();
  for (std::size_t i = 0; i < 2; ++i) {
    Json of_line = request;
    of_line["line"] = lines_[i];
    history_.ask_once(owner_, of_line, [replies, use, i](std::string text) {
      (*replies)[i] = std::move(text);
      if (!(*replies)[0].empty() && !(*replies)[1].empty()) use(*replies);
    });
  }
}

void Comparison::compare_digests() {
  Json times = Json::array();
  for (std::int64_t i = 1; i <= parts; ++i) times.push_back((part_.from + (part_.to - part_.from) / parts * i).ns());
  times.back() = part_.to.ns();
  const auto self = shared_from_this();
  ask_both({{"ask", "digests"}, {"from", part_.from.ns()}, {"times", times}}, [self, times](const auto& replies) {
    const Json one = Json::parse(replies[0]), other = Json::parse(replies[1]);
    if (one.contains("error")) return self->reply_(replies[0]);
    if (other.contains("error")) return self->reply_(replies[1]);
    std::size_t i = 0;
    while (i < times.size() && one["digests"][i] == other["digests"][i]) ++i;
    if (i == times.size()) return self->reply_(text_of(Json{{"event", nullptr}}));
    if (i > 0) self->part_.from = Time::from_ns(times[i - 1].get<std::int64_t>());
    self->part_.to = Time::from_ns(times[i].get<std::int64_t>());
    self->values_differ_ = self->part_.to;
    self->part_.to - self->part_.from > part_least ? self->compare_digests() : self->compare_events();
  });
}

void Comparison::compare_events() {
  const Json request = {{"ask", "events"}, {"from", part_.from.ns()}, {"to", part_.to.ns()}, {"most", events_compared}};
  ask_both(request, [self = shared_from_this()](const auto& replies) { self->decide(replies); });
}

// Values may differ before events do: then the next part is looked at.
void Comparison::decide(const std::array<std::string, 2>& replies) {
  const Json one = Json::parse(replies[0]), other = Json::parse(replies[1]);
  if (one.contains("error")) return reply_(replies[0]);
  if (other.contains("error")) return reply_(replies[1]);
  const std::size_t count = one["t"].size(), count_other = other["t"].size();
  std::int64_t time = part_.from.ns();
  for (std::size_t i = 0; i < std::max(count, count_other); ++i) {
    const bool is_in_both = i < count && i < count_other;
    const std::string a = i < count ? words(one, i) : "", b = i < count_other ? words(other, i) : "";
    const auto step = [i](const Json& events, std::size_t size) {
      return i < size ? events["t"][i].get<std::int64_t>() : std::numeric_limits<std::int64_t>::max();
    };
    const std::int64_t step_one = step(one, count), step_other = step(other, count_other);
    time += std::min(step_one, step_other);
    if (is_in_both && a == b && step_one == step_other) continue;
    const std::uint64_t first = one["first"];
    return reply_(text_of(Json{{"event", first + i}, {"time", time}, {"a", a}, {"b", b}}));
  }
  if (part_.to >= end_) return reply_(text_of(Json{{"event", nullptr}, {"time", values_differ_.ns()}}));
  const Duration length = (part_.to - part_.from) * 2;
  part_.from = part_.to;
  part_.to = std::min(end_, part_.from + length);
  compare_events();
}

}  // namespace waitpoint::tools::view
