// SPDX-License-Identifier: BSD-3-Clause
#include "tools/view/recorded_page.hpp"

#include <utility>

#include "tools/output/summary.hpp"
#include "tools/view/module_lines.hpp"
#include "tools/view/page.hpp"
#include "tools/view/run_states.hpp"
#include "tools/view/view_json.hpp"

namespace waitpoint::tools::view {
namespace {

constexpr Duration period_least = std::chrono::milliseconds(100);
constexpr std::size_t robots_at_full_rate = 10, plots_max = 1000, events_max = 2'000'000;
// From these sizes on, frames come half as often.
constexpr std::size_t bytes_at_full_rate = 1'000'000;

}  // namespace

void RecordedPage::begin(const scenario::Scenario& scenario, run::Experiment& experiment, const SceneOptions& options) {
  experiment_ = &experiment;
  for (const auto& robot : experiment.robots()) robot->set_watch(&logs_.emplace_back(robot->watch()));
  frames_.emplace(scenario, experiment);
  plots_.emplace(experiment);
  if (plots_->size() > plots_max) plots_.reset();
  counts_.emplace(experiment);
  events_.emplace(experiment.simulation().scheduler(), events_max);
  const auto crowd = static_cast<std::int64_t>(experiment.robots().size() / robots_at_full_rate);
  period_ = period_least * (1 + crowd);
  scan_period_ = period_ * 5;
  text_.append("{\"header\":" + text_of(scene(scenario, experiment, options)) + ",\"frames\":[");
  take_frame(Time());
}

void RecordedPage::step(Time now) {
  counts_->take(now);
  if (now >= next_) take_frame(now);
}

void RecordedPage::take_frame(Time now) {
  if (std::exchange(has_frame_, true)) text_.append(",");
  const bool scans = now >= next_scan_;
  if (scans) next_scan_ = now + scan_period_;
  text_.append(frames_->read(now, {.scans = scans}) + "}");
  if (plots_) plots_->take(now);
  next_ = now + period_;
  for (std::size_t bytes = bytes_at_full_rate; bytes < text_.size(); bytes *= 2) next_ = next_ + period_;
}

void RecordedPage::finish(const bridge::RunResult& result) {
  const Time end = Time() + result.simulated;
  take_frame(end);
  text_.append("],\"events\":" + events_->text(Time(), end + Duration::from_ns(1)));
  text_.append(",\"tasks\":" + text_of(task_states(*experiment_)) + ",\"modules\":[");
  for (std::size_t i = 0; i < experiment_->robots().size(); ++i)
    text_.append((i > 0 ? "," : "") + text_of(module_states(*experiment_, i)));
  text_.append("]," + (plots_ ? plots_->text() : std::string("\"plot_times\":[],\"plots\":[]")));
  text_.append(",\"counts\":" + counts_->text() + ",\"log\":" + text_of(take_lines(logs_)));
  bridge::RunResult of_every_machine = result;
  of_every_machine.wall_s = 0;
  text_.append(",\"summary\":" + text_of(Json(summary_text(of_every_machine))) + "}");
  file_.write(page_of(base64(text_.finish())));
  file_.commit();
}

}  // namespace waitpoint::tools::view
