// SPDX-License-Identifier: BSD-3-Clause
#include "modules/logs/playing_order.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/error.hpp"

namespace waitpoint::logs {
namespace {

using namespace std::chrono_literals;

constexpr Duration set_back_least = 1s, apart_most = 24h, least_step = 1us;
// A day at 100 m/s: the base's counters hold it, in their units.
constexpr double way_max_m = 1e7;

struct Entry {
  Time stamp;  // then the date
  Time received;
  std::uint64_t place;
  const LoggedScan* scan;          // or null
  const LoggedOdometry* odometry;  // or null
};

std::vector<Entry> in_order_of_the_log(const SensorLog& log) {
  std::vector<Entry> entries;
  for (const LoggedScan& scan : log.scans) entries.push_back({scan.stamp, scan.received, scan.place, &scan, nullptr});
  for (const LoggedOdometry& report : log.odometry)
    entries.push_back({report.stamp, report.received, report.place, nullptr, &report});
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.received, a.place) < std::tie(b.received, b.place);
  });
  return entries;
}

// Replaces the stamps by dates.
void date_in_order_of_the_log(std::vector<Entry>& entries, const std::string& file, PlayingOrder& order) {
  Time before = entries.front().stamp, date, greatest;
  for (Entry& entry : entries) {
    const Duration since = entry.stamp - before;
    before = entry.stamp;
    if (since > apart_most || greatest - date > since + set_back_least) {
      ++order.clock_set;
      date = greatest;
    } else {
      date += since;
    }
    order.late += date < greatest ? 1 : 0;
    greatest = std::max(greatest, date);
    if (greatest - Time() > apart_most)
      throw BadInput(file, "expected a log of at most a day, found a stamp of " + to_string(entry.stamp));
    entry.stamp = date;
  }
}

void sort_by_date(std::vector<Entry>& entries) {
  std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.stamp < b.stamp; });
  std::vector<Time> scans;
  for (const Entry& entry : entries)
    if (entry.scan != nullptr) scans.push_back(entry.stamp);
  std::erase_if(entries, [&](const Entry& entry) {
    return entry.odometry != nullptr && std::binary_search(scans.begin(), scans.end(), entry.stamp);
  });
}

/// The odometry's pose at a stamp that grows from call to call.
class OdometryAt {
 public:
  explicit OdometryAt(const std::vector<Entry>& entries) {
    for (const Entry& entry : entries)
      if (entry.odometry != nullptr) reports_.push_back({entry.stamp, entry.odometry->pose});
    std::stable_sort(reports_.begin(), reports_.end(),
                     [](const Report& a, const Report& b) { return a.stamp < b.stamp; });
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

void check_way(const std::vector<Played>& records, const std::string& file) {
  double way_m = 0;
  for (std::size_t i = 1; i < records.size(); ++i)
    way_m += length(records[i].odometry.position() - records[i - 1].odometry.position());
  if (way_m > way_max_m)
    throw BadInput(file, "expected odometry of at most 10000 km in all, found " +
                             std::to_string(std::llround(way_m / 1000)) + " km");
}

}  // namespace

PlayingOrder playing_order(const SensorLog& log) {
  PlayingOrder order;
  std::vector<Entry> entries = in_order_of_the_log(log);
  if (entries.empty()) return order;
  date_in_order_of_the_log(entries, log.file, order);
  OdometryAt odometry_at(entries);
  sort_by_date(entries);
  const Time first = entries.front().stamp;
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
  check_way(order.records, log.file);
  return order;
}

}  // namespace waitpoint::logs
