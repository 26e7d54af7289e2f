// SPDX-License-Identifier: BSD-3-Clause
// The module of the laser range finder: speaks to the device by two posters.
//
//   reads    sick.reading (the device's scans)
//   writes   sick.command (to the device), sick.echoes, sick.segments
//   requests ContinuousShot: switches the device on and exports every scan until it is interrupted; Stop ends it.
//            SegmentsOn, SegmentsOff: whether segments of aligned echoes are exported too (on at first)
#pragma once

#include "modules/genom/module.hpp"
#include "modules/posters/laser.hpp"
#include "modules/sick/segment_extraction.hpp"

namespace waitpoint::sick {

/// What can be set of the module.
struct Parameters {
  double mount_x_m = 0.1, mount_y_m = 0, mount_heading_deg = 0;  ///< where the device sits on the robot
  /// How much earlier than its date, which is that of its last beam, a scan counts as measured: half the time that the
  /// mirror takes for it.
  Duration scan_age_ms;
  SegmentExtractionParameters segments;

  static constexpr auto fields() {
    return std::tuple(field("mount_x_m", &Parameters::mount_x_m), field("mount_y_m", &Parameters::mount_y_m),
                      field("mount_heading_deg", &Parameters::mount_heading_deg),
                      field("scan_age_ms", &Parameters::scan_age_ms), field("segments", &Parameters::segments));
  }
};

class Sick : public genom::Module {
 public:
  explicit Sick(genom::ModuleSetup& setup);

 private:
  static Parameters read(genom::Settings& settings);
  void export_scan();

  Parameters parameters_;
  SegmentExtraction extraction_;
  genom::ExecutionTask& scanning_;
  genom::PosterLink<posters::LaserReading>& reading_;
  posters::LaserCommand command_;
  genom::OutputPoster<posters::LaserCommand>& command_poster_;
  genom::OutputPoster<posters::Echoes>& echoes_poster_;
  genom::OutputPoster<posters::Segments>& segments_poster_;
  posters::Echoes echoes_;
  posters::Segments segments_;
  std::uint32_t number_ = 0;  // of the last scan exported
  bool with_segments_ = true;
};

}  // namespace waitpoint::sick
