// SPDX-License-Identifier: BSD-3-Clause
// The source of an external robot's position reports: docs/external.md has the protocol.
//
//   it says                                     the run answers
//                                               waitpoint reports 1 ROBOT
//   clock own|unix|run                          (nothing)
//   report stamp_s=T x_m=X y_m=Y heading_rad=A  taken T at DATE, superseded T, or refused: REASON
//
// Of the reports that came since the world's last step the newest counts. A source that does not read the answers loses
// them. There is one source at a time; after it the next may connect.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "modules/outside/endpoint.hpp"
#include "modules/outside/fault_counts.hpp"
#include "modules/outside/line_stream.hpp"
#include "modules/outside/partner.hpp"
#include "modules/outside/source_clock.hpp"
#include "modules/run/position_report.hpp"

namespace waitpoint::outside {

class ReportSource final : public Partner {
 public:
  /// `declaration` are the words of the intervention `external` behind the robot's name. Throws BadInput at `where` if
  /// the endpoint cannot be had.
  ReportSource(std::string robot, const Endpoint& endpoint, std::string declaration, const std::string& where);

  void begin(Host& host) override;
  void take_in(Host& host) override;
  std::string account() const override;

 private:
  struct Connection {
    explicit Connection(Descriptor descriptor) : lines(std::move(descriptor)) {}

    LineStream lines;
    SourceClock clock;
    std::uint64_t reports = 0;
    FaultCounts faults;
  };

  void accept(Host& host);
  void hear(Host& host);
  void obey(std::string_view line, Host& host);
  void obey_report(std::string_view words, const scenario::Location& written, Host& host);
  void refuse(const char* kind, const std::string& reason, Host& host);
  void give_newest(Host& host);
  void end_connection(Host& host);

  std::string robot_, declaration_, where_;
  Listener listener_;
  std::optional<Connection> connection_;
  std::optional<run::PositionReport> newest_;  // of this step, with its stamp
  double newest_date_s_ = 0;
  std::uint64_t connections_ = 0, reports_ = 0;
  FaultCounts faults_;  // of all connections
};

}  // namespace waitpoint::outside
