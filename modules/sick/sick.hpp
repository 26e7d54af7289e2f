// SPDX-License-Identifier: BSD-3-Clause
// The module of the laser range finder: the driver of the device, through two posters.
//
//   reads    sick.reading (the device's scans)
//   writes   sick.command (to the device), sick.echoes, sick.segments
//   requests ContinuousShot: switches the device on and exports every scan until interrupted; Stop ends it.
//            SegmentsOn, SegmentsOff: enable and disable the export of segments (initially on)
#pragma once

#include "modules/genom/module.hpp"
#include "modules/posters/laser.hpp"
#include "modules/sick/segment_extraction.hpp"

namespace waitpoint::sick {

/// Parameters of the module.
struct Parameters {
  double mount_x_m = 0.1, mount_y_m = 0, mount_heading_deg = 0;
  Duration scan_age_ms;
  SegmentExtractionParameters segments;

  static void fields(auto field) {
    field("mount_x_m", &Parameters::mount_x_m, "pose of the device on the robot");
    field("mount_y_m", &Parameters::mount_y_m, "the same");
    field("mount_heading_deg", &Parameters::mount_heading_deg, "the same");
    field("scan_age_ms", &Parameters::scan_age_ms,
          "age of a scan at its date, which is that of its last beam: half the mirror's time for a scan");
    field("segments", &Parameters::segments, "extraction of segments from scans");
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
  std::uint32_t number_ = 0;  // number of the last scan exported
  bool with_segments_ = true;
};

}  // namespace waitpoint::sick
