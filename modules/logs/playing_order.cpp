// SPDX-License-Identifier: BSD-3-Clause
#include "modules/logs/playing_order.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace waitpoint::logs {
namespace {

using namespace std::chrono_literals;

constexpr Duration set_back_least = 1s, apart_most = 24h, least_step = 1us;

struct Entry {
  Time stamp;
  std::uint64_t place;
  const LoggedScan* scan;          // or null
  const LoggedOdometry* odometry;  // or null
};

std::vector<Entry> in_order_of_the_log(const SensorLog& log) {
  std::vector<Entry> entries;
  for (const LoggedScan& scan : log.scans) entries.push_back({scan.stamp, scan.place, &scan, nullptr});
  for (const LoggedOdometry& report : log.odometry) entries.push_back({report.stamp, report.place, nullptr, &report});
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.place < b.place; });
  return entries;
}

void sort_by_stamp(std::vector<Entry>& entries, PlayingOrder& order) {
  Duration moved;
  Time greatest = entries.front().stamp;
  for (Entry& entry : entries) {
    entry.stamp += moved;
    if (greatest - entry.stamp > set_back_least) {
      ++order.set_back;
      moved += greatest - entry.stamp;
      entry.stamp = greatest;
    }
    order.late += entry.stamp < greatest ? 1 : 0;
    greatest = std::max(greatest, entry.stamp);
  }
  std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.stamp < b.stamp; });
}

/// The odometry's pose at a stamp that grows from call to call.
class OdometryAt {
 public:
  explicit OdometryAt(const std::vector<Entry>& entries) {
    for (const Entry& entry : entries)
      if (entry.odometry != nullptr) reports_.push_back({entry.stamp, entry.odometry->pose});
  }
  Pose operator()(Time stamp) {
    WAITPOINT_CHECK(!reports_.empty(), "a scan without odometry in a log without odometry");
    while (next_ < reports_.size() && reports_[next_].stamp <= stamp) ++next_;
    if (next_ == 0) return reports_.front().pose;
    if (next_ == reports_.size()) return reports_.back().pose;
    const Report &before = reports_[next_ - 1], &after = reports_[next_];
    const double fraction =
        static_cast<double>((stamp - before.stamp).ns()) / static_cast<double>((after.stamp - before.stamp).ns());
    return interpolate(before.pose, after.pose, fraction);
  }

 private:
  struct Report {
    Time stamp;
    Pose pose;
  };
  std::vector<Report> reports_;
  std::size_t next_ = 0;
};

}  // namespace

PlayingOrder playing_order(const SensorLog& log) {
  PlayingOrder order;
  std::vector<Entry> entries = in_order_of_the_log(log);
  if (entries.empty()) return order;
  sort_by_stamp(entries, order);
  const Time first = entries.front().stamp;
  if (entries.back().stamp - first > apart_most)
    throw BadInput(log.file, "expected stamps within a day, found " + to_string(first) + " and " +
                                 to_string(entries.back().stamp));
  OdometryAt odometry_at(entries);
  for (const Entry& entry : entries) {
    Played played;
    played.date = Time() + (entry.stamp - first);
    if (!order.records.empty() && played.date <= order.records.back().date) {
      ++order.equal;
      played.date = order.records.back().date + least_step;
    }
    if (entry.odometry != nullptr) {
      played.odometry = entry.odometry->pose;
    } else {
      played.odometry = entry.scan->odometry ? *entry.scan->odometry : odometry_at(entry.stamp);
      played.scan = static_cast<std::size_t>(entry.scan - log.scans.data());
    }
    order.records.push_back(played);
  }
  return order;
}

}  // namespace waitpoint::logs
