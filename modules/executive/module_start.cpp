// SPDX-License-Identifier: BSD-3-Clause
#include "modules/executive/module_start.hpp"

namespace waitpoint::executive {

void start_modules(genom::Client& client, const genom::NameSpace& names,
                   const std::optional<posters::KnownPose>& start) {
  const posters::KnownPose pose = start.value_or(posters::KnownPose());
  client.call("rflex", "SetPos", pose);
  client.call("pom", "SetPos", pose);
  client.send("sick", "ContinuousShot");
  if (names.find_module("segloc") != nullptr) client.send("segloc", "Localise", pose);
  if (names.find_module("locate") != nullptr) {
    if (start)
      client.send("locate", "Localise", pose);
    else
      client.send("locate", "Find");
  }
  client.send("rflex", "TrackSpeedStart");
}

}  // namespace waitpoint::executive
