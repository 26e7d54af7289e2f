// SPDX-License-Identifier: BSD-3-Clause
// The world of a run, served to the software of robots in other processes: docs/external.md has the protocol.
//
//   a client says                             the run answers
//                                             waitpoint world 1 SCENARIO step_s=S
//   robot NAME                                attached NAME, or refused: REASON
//   command v_m_s=V w_rad_s=W ...             taken at DATE
//   sensor NAME on|off                        (nothing); also `laser` of a laser
//
// and after each step of the world the readings of the attached robot: `base`, `truth`, the new
// readings of the sensors that are on, and then `step DATE`. Of several commands since the last step the newest counts.
// Commands are interventions; when a client leaves, its robot is told to stop.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "modules/outside/endpoint.hpp"
#include "modules/outside/fault_counts.hpp"
#include "modules/outside/line_stream.hpp"
#include "modules/outside/partner.hpp"
#include "modules/scenario/scenario.hpp"
#include "world/world.hpp"

namespace waitpoint::outside {

class WorldServer final : public Partner {
 public:
  /// The robots named in `taken` are moved by others. The scenario must outlive the server. Throws BadInput at `where`
  /// if the endpoint cannot be had.
  WorldServer(const scenario::Scenario& scenario, std::vector<std::string> taken, const Endpoint& endpoint,
              const std::string& where);

  void begin(Host& host) override;
  void publish(Host& host) override;
  void take_in(Host& host) override;
  std::string account() const override;

 private:
  struct Sensor {
    std::string name;
    bool is_laser, is_on = false;
    std::function<std::string(const world::World& world)> lines = {};  // of its new readings
  };
  struct Client {
    explicit Client(Descriptor descriptor) : lines(std::move(descriptor)) {}

    LineStream lines;
    std::optional<std::size_t> robot;
    std::vector<Sensor> sensors;
    std::string command;  // of this step
    FaultCounts faults;
  };

  void obey(Client& client, std::string_view line, Host& host);
  void attach(Client& client, const std::string& name, const scenario::Location& written, Host& host);
  void switch_sensor(Client& client, const std::string& kind, std::string_view words,
                     const scenario::Location& written);
  void end(Client& client, Host& host);
  std::string name(const Client& client) const;
  std::string readings(Client& client, const world::World& world) const;
  std::vector<Sensor> sensors_of(std::size_t robot) const;

  const scenario::Scenario& scenario_;
  std::vector<std::string> taken_;
  std::string where_;
  Listener listener_;
  std::vector<std::unique_ptr<Client>> clients_;
  std::uint64_t connections_ = 0, commands_ = 0;
  std::optional<std::uint64_t> published_;  // step
  FaultCounts faults_;
};

}  // namespace waitpoint::outside
