// SPDX-License-Identifier: BSD-3-Clause
#include "tools/view/history/time_lines.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "tools/view/request.hpp"

namespace waitpoint::tools::view {
namespace {

constexpr std::size_t lines_max = 32;

}  // namespace

std::size_t TimeLines::number_in(const Json& request, const char* key) const {
  const auto last = static_cast<std::int64_t>(lines_.size()) - 1;
  return static_cast<std::size_t>(whole_number_in(request, key, 0, last, 0));
}

void TimeLines::check_room() const {
  if (lines_.size() >= lines_max) throw BadInput("the view", "there are too many lines of time");
}

std::size_t TimeLines::add(TimeLine line) {
  check_room();
  lines_.push_back(std::move(line));
  return lines_.size() - 1;
}

void TimeLines::add_snapshot(Snapshot snapshot, std::uint64_t copied_bytes, const Copies::Use& leave) {
  TimeLine& run = lines_.front();
  if (!run.snapshots.empty()) run.snapshots.back().copied_bytes = copied_bytes;
  run.reached = std::max(run.reached, snapshot.time);
  run.snapshots.push_back(std::move(snapshot));
  thin_out(run.snapshots, bytes_max_, leave);
}

Origin TimeLines::origin(std::size_t line, const IsEarly& is_early) const {
  std::vector<DatedText> to_come;
  const Snapshot* first = nullptr;
  Time end = Time::max();
  for (int at = static_cast<int>(line); at >= 0; at = lines_[static_cast<std::size_t>(at)].parent) {
    const TimeLine& current = lines_[static_cast<std::size_t>(at)];
    const Snapshot* found = nullptr;
    for (const Snapshot& snapshot : current.snapshots) {
      if (!snapshot.peer->is_open() || snapshot.time > end) continue;
      if (found == nullptr || is_early(snapshot)) found = &snapshot;
    }
    if (found != nullptr && (is_early(*found) || current.parent < 0)) first = found;
    if (first != nullptr) return {first->peer, first->time, to_come};
    to_come.insert(to_come.begin(), current.interventions.begin(), current.interventions.end());
    end = std::min(end, current.from);
  }
  throw BadInput("the view", "there is no snapshot of this run");
}

std::size_t TimeLines::line_at(std::size_t line, Time time) const {
  while (lines_[line].parent >= 0 && time < lines_[line].from) line = static_cast<std::size_t>(lines_[line].parent);
  return line;
}

// From the run to the line, both included.
std::vector<std::size_t> TimeLines::way_to(std::size_t line) const {
  std::vector<std::size_t> way = {line};
  while (lines_[way.back()].parent >= 0) way.push_back(static_cast<std::size_t>(lines_[way.back()].parent));
  std::reverse(way.begin(), way.end());
  return way;
}

TimeLines::Span TimeLines::apart(std::size_t line, std::size_t other) const {
  if (line == other) throw BadInput("the view", "expected two lines of time, found one");
  const std::vector<std::size_t> one = way_to(line), two = way_to(other);
  const auto [leaves_one, leaves_two] = std::mismatch(one.begin(), one.end(), two.begin(), two.end());
  Time from = Time::max();
  if (leaves_one != one.end()) from = lines_[*leaves_one].from;
  if (leaves_two != two.end()) from = std::min(from, lines_[*leaves_two].from);
  from = from + Duration::from_ns(1);  // a branch has all events of the instant at which it leaves
  return {from, std::max(from, std::min(end(line), end(other)))};
}

Json TimeLines::status() const {
  Json list = Json::array();
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const TimeLine& line = lines_[i];
    list.push_back({{"line", i},
                    {"from", line.from.ns()},
                    {"to", end(i).ns()},
                    {"parent", line.parent >= 0 ? Json(line.parent) : Json(nullptr)},
                    {"name", line.name}});
  }
  return list;
}

}  // namespace waitpoint::tools::view
