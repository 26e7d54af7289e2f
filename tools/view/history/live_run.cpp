// SPDX-License-Identifier: BSD-3-Clause
#include "tools/view/history/live_run.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "modules/run/ranks/processor_time.hpp"
#include "tools/output/progress.hpp"
#include "tools/output/summary.hpp"
#include "tools/view/history/run_copy.hpp"
#include "tools/view/module_lines.hpp"
#include "tools/view/request.hpp"

namespace waitpoint::tools::view {
namespace {

// Processor time between snapshots at first, which bounds the time that a look at the past takes.
constexpr double snapshot_period_s = 0.1;
// Of a crowd, much is written between two snapshots, and each page of it copied, in some two microseconds: that may
// take this share of the run's time. The first guess is of a copy of everything.
constexpr double copying_share = 0.1, copying_s_per_byte = 5e-10;
constexpr double status_period_s = 0.1;
constexpr int pause_ms = 50;

}  // namespace

LiveRun::LiveRun(Channel& viewer, const scenario::Scenario& scenario, run::Experiment& experiment,
                 const SceneOptions& options, std::string journal)
    : viewer_(viewer),
      experiment_(experiment),
      journal_(std::move(journal)),
      frames_(scenario, experiment),
      counts_(experiment),
      snapshot_period_s_(snapshot_period_s) {
  for (const auto& robot : experiment.robots()) robot->set_watch(&logs_.emplace_back(robot->watch()));
  viewer_.send(text_of(scene(scenario, experiment, options)));
  make_snapshot();
}

void LiveRun::make_snapshot() {
  const MemoryUse use = memory_use();
  const auto period_for = [](std::uint64_t bytes) {
    return copying_s_per_byte / copying_share * static_cast<double>(bytes);
  };
  const std::uint64_t copied = use.copied_bytes - at_snapshot_.copied_bytes;
  if (copying_period_s_ == 0)
    copying_period_s_ = period_for(use.bytes);
  else if (period_for(copied) > copying_period_s_)
    copying_period_s_ *= 2;
  else if (period_for(copied) < copying_period_s_ / 2)
    copying_period_s_ /= 2;
  const RunCopy here(frames_, experiment_, journal_, reached_, counts_);
  const Channel copy = here.fork();
  viewer_.send(
      text_of(
          Json{{"kind", "snapshot"}, {"time", reached_.ns()}, {"events", experiment_.events()}, {"copied", copied}}),
      copy.number());
  at_snapshot_ = use;
  next_snapshot_s_ = run::processor_s() + std::max(snapshot_period_s_, copying_period_s_);
}

void LiveRun::after_window(Time reached, const std::function<bool()>& is_over) {
  reached_ = reached;
  counts_.take(reached);
  if (!viewer_.is_open()) return;
  take_requests();
  if (run::processor_s() >= next_snapshot_s_) make_snapshot();
  send_frame();
  if (wall_clock_s() >= next_status_s_) {
    send_status();
    send_log();
  }
  while (is_paused_ && viewer_.is_open() && !is_over()) {
    viewer_.has_news(pause_ms);
    take_requests();
    send_frame();
  }
}

void LiveRun::send_frame() {
  if (wanted_) viewer_.send(frames_.read(reached_, *wanted_) + "}");
  wanted_.reset();
}

void LiveRun::take_requests() {
  while (const auto message = viewer_.poll()) heed(message->text);
}

void LiveRun::heed(const std::string& text) {
  const Json request = Json::parse(text);
  const std::string what = request.at("do");
  if (what == "frame") wanted_ = frame_options(request, experiment_.robots().size());
  if (what == "pause") {
    is_paused_ = request.at("on");
    send_status();
  }
  if (what == "speed") speed_ = request.at("value").get<double>();
  if (what == "thin") snapshot_period_s_ *= 2;
}

void LiveRun::send_status() {
  next_status_s_ = wall_clock_s() + status_period_s;
  viewer_.send(text_of(Json{{"kind", "status"},
                            {"time", reached_.ns()},
                            {"events", experiment_.events()},
                            {"over", false},
                            {"outcome", ""},
                            {"paused", is_paused_}}));
}

void LiveRun::send_log() {
  const Json lines = take_lines(logs_);
  if (!lines.empty()) viewer_.send(text_of(Json{{"kind", "log"}, {"lines", lines}}));
}

void LiveRun::finish(const bridge::RunResult& result) {
  if (!viewer_.is_open()) return;
  send_log();
  make_snapshot();
  viewer_.send(text_of(Json{{"kind", "status"},
                            {"time", result.simulated.ns()},
                            {"events", result.events},
                            {"over", true},
                            {"outcome", std::string(bridge::to_string(result.outcome))},
                            {"paused", false},
                            {"digest", to_string(result.digest)},
                            {"summary", summary_text(result)}}));
}

}  // namespace waitpoint::tools::view
