// SPDX-License-Identifier: BSD-3-Clause
#include "modules/playback/playback.hpp"

#include <algorithm>
#include <array>
#include <iterator>

#include "core/error.hpp"
#include "core/number_text.hpp"
#include "fibers/sync/thread.hpp"
#include "modules/bridge/module_making.hpp"
#include "modules/playback/log_settings.hpp"
#include "modules/posters/corrected_trajectory.hpp"
#include "modules/posters/navigation.hpp"

namespace waitpoint::playback {
namespace {

using namespace std::chrono_literals;

// Shorter than the shortest period of a module that localises: no value of a poster is missed.
constexpr Duration window = 10ms;
constexpr Duration after_last = 1s;

// Beyond it, nothing is known of the way between two poses.
constexpr Duration gap_max = 2s;

/// The pose at `date` by samples around it; nothing before the first and after the last, and in a gap between two.
std::optional<Pose> pose_at(const std::vector<bridge::DatedPose>& samples, Time date) {
  const auto after = std::lower_bound(samples.begin(), samples.end(), date,
                                      [](const bridge::DatedPose& sample, Time t) { return sample.date < t; });
  if (after == samples.end()) return std::nullopt;
  if (after->date == date) return after->pose;
  if (after == samples.begin()) return std::nullopt;
  const bridge::DatedPose& before = *(after - 1);
  if (after->date - before.date > gap_max) return std::nullopt;
  const double fraction =
      static_cast<double>((date - before.date).ns()) / static_cast<double>((after->date - before.date).ns());
  return interpolate(before.pose, after->pose, fraction);
}

template <class T>
const genom::Poster<T>* find(const genom::NameSpace& names, const std::string& name) {
  return dynamic_cast<const genom::Poster<T>*>(names.find_poster(name));
}

}  // namespace

Playback::Playback(const logs::SensorLog& log, const scenario::RobotScenario& robot,
                   std::span<const genom::ModuleType> types, const SimulationOptions& options)
    : log_(log), robot_(robot), order_(logs::playing_order(log)), simulation_(options) {
  WAITPOINT_CHECK(!order_.records.empty(), "a log without records");
  DevicePosters posters;
  for (const scenario::BridgeRow& row : robot.bridge) {
    if (row.device == "base.reading") posters.base = row.poster;
    if (!robot.laser_names.empty() && row.device == robot.laser_names.front() + ".reading") posters.laser = row.poster;
  }
  for (const std::string& name : robot.processors) names_.add_processor(name);
  player_.emplace(log_, order_, names_, posters);
  make_modules(types);
  check_readers();
  localisation_ = find<posters::Localisation>(names_, name_of("segloc") + ".localisation");
  position_ = find<posters::FusedPosition>(names_, name_of("pom") + ".position");
  kernel::Robot& lane = simulation_.add_robot(robot.name);
  simulation_.spawn(lane, {.name = "player", .phase = kernel::Phase::world, .service = true}, [this] {
    begin_.acquire();
    player_->run();
    end_.release();
  });
  sync::start_thread(simulation_.scheduler(), lane, {.name = "replay"}, sync::make_call([this] { run_modules(); }));
}

Playback::~Playback() { simulation_.unwind(); }

void Playback::make_modules(std::span<const genom::ModuleType> types) {
  for (const scenario::ModuleScenario& module : robot_.modules) {
    if (!module.enabled) continue;
    scenario::ModuleScenario with_log = module;
    with_log.settings = settings_of(module);
    genom::ModuleSetup setup{names_, with_log.name, genom::Settings(with_log.settings)};
    modules_.push_back(bridge::make_module(with_log, types, robot_.name, setup));
  }
  for (const auto& module : modules_) module->connect();
}

std::vector<Setting> Playback::settings_of(const scenario::ModuleScenario& module) const {
  std::vector<Setting> settings = module.settings;
  set_by_log(module.type, log_, settings);
  // Of real scans, few are held by segments.
  const auto is_start = [](const Setting& setting) { return setting.key == "points.from_start"; };
  if (module.type == "segloc" && std::none_of(settings.begin(), settings.end(), is_start))
    settings.push_back({"points.from_start", "true", log_.file, 0});
  return settings;
}

void Playback::check_readers() const {
  for (const genom::PosterBase* poster : player_->posters())
    if (!poster->has_reader())
      throw robot_.written.bad("expected a module that reads '" + poster->name() + "', which the log feeds");
}

/// The name of the first module of that type; the type if there is none.
std::string Playback::name_of(const char* module_type) const {
  for (const scenario::ModuleScenario& module : robot_.modules)
    if (module.enabled && module.type == module_type) return module.name;
  return module_type;
}

template <class Input>
void Playback::request(genom::Client& client, const char* module_type, const char* request, const Input& input) {
  const std::string module = name_of(module_type);
  const genom::Module* const found = names_.find_module(module);
  if (found == nullptr) return;
  const genom::RequestType* const type = found->find_request(request);
  if (type == nullptr) return;
  if (type->kind == genom::RequestKind::control)
    client.call(module, request, input);
  else
    client.send(module, request, input);
}

void Playback::run_modules() {
  for (const auto& module : modules_) module->start();
  genom::Client client(names_, "replay of the log");
  const posters::KnownPose start;
  request(client, "rflex", "SetPos", start);
  request(client, "pom", "SetPos", start);
  request(client, "sick", "ContinuousShot", genom::Nothing());
  request(client, "segloc", "Localise", start);
  begin_.release();
  end_.acquire();
  threads::this_thread::sleep_for(std::chrono::nanoseconds(after_last.ns()));
}

RunEnd Playback::run_before(Time until) {
  RunEnd end = RunEnd::time_reached;
  while (end == RunEnd::time_reached && reached_ < until) {
    const Time next = std::min(until, Time() + window * (reached_.since_start() / window + 1));
    end = simulation_.run_before(next);
    reached_ = next;
    observe();
  }
  if (const std::string& unread = player_->unread(); !unread.empty())
    throw robot_.written.bad("expected a module that reads '" + unread + "' at least every " +
                             number_text(LogPlayer::patience.seconds()) + " s, which the log feeds");
  return end;
}

void Playback::observe() {
  const auto add = [](std::vector<bridge::DatedPose>& samples, const posters::PositionEstimate& position) {
    if (samples.empty() || samples.back().date < position.date) samples.push_back({position.date, position.pose});
  };
  if (localisation_ != nullptr)
    if (const auto value = localisation_->look()) add(localised_, value->position);
  if (position_ != nullptr)
    if (const auto value = position_->look()) add(fused_, value->position);
}

bool Playback::has(PoseSource source) const {
  return source == PoseSource::odometry ||
         (source == PoseSource::segloc ? localisation_ != nullptr : position_ != nullptr);
}

// The uncorrected value, as it was known at the time.
std::vector<bridge::DatedPose> Playback::corrected() const {
  std::vector<bridge::DatedPose> poses;
  for (const auto& module : modules_)
    if (const auto* const source = dynamic_cast<const posters::CorrectedTrajectory*>(module.get());
        source && poses.empty())
      for (const posters::StampedPose& at : source->corrected()) poses.push_back({at.date, at.pose});
  std::vector<bridge::DatedPose> all;
  const auto by_date = [](const bridge::DatedPose& a, const bridge::DatedPose& b) { return a.date < b.date; };
  std::set_union(poses.begin(), poses.end(), localised_.begin(), localised_.end(), std::back_inserter(all), by_date);
  return all;
}

std::vector<StampedPose> Playback::trajectory(PoseSource source) const {
  std::vector<StampedPose> trajectory;
  const std::vector<bridge::DatedPose> samples = source == PoseSource::segloc ? corrected()
                                                 : source == PoseSource::pom  ? fused_
                                                                              : std::vector<bridge::DatedPose>();
  const Pose& origin = order_.records.front().odometry;
  for (const logs::Played& record : order_.records) {
    if (!record.scan || record.date >= reached_) continue;
    const std::optional<Pose> pose = source == PoseSource::odometry ? std::optional(between(origin, record.odometry))
                                                                    : pose_at(samples, record.date);
    if (pose) trajectory.push_back({log_.scans[*record.scan].stamp, *pose, *record.scan});
  }
  return trajectory;
}

std::vector<bridge::Line> Playback::segments() const {
  std::vector<bridge::Line> lines;
  const auto* const map = find<posters::SegmentMap>(names_, "segloc.map");
  if (const auto segments = map != nullptr ? map->look() : std::nullopt)
    for (const posters::MapSegment& segment : segments->items) lines.push_back({segment.start, segment.end});
  return lines;
}

}  // namespace waitpoint::playback
