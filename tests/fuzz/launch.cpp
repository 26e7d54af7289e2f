// SPDX-License-Identifier: BSD-3-Clause
// Launch files of ROS 1, with YAML within.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "modules/ros1/launch_file.hpp"
#include "modules/scenario/parameter_value.hpp"
#include "tests/fuzz/input_folder.hpp"
#include "tests/fuzz/refusal.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  namespace ros1 = waitpoint::ros1;
  static const waitpoint::fuzz::InputFolder folder;
  const std::string contents(reinterpret_cast<const char*>(data), size);
  waitpoint::fuzz::reads_or_refuses([&] {
    ros1::LaunchSurroundings surroundings = {
        ros1::Packages(std::vector<std::filesystem::path>()),
        [](const std::string& name) { return name == "HOME" ? std::optional<std::string>("/") : std::nullopt; },
        [](const std::string& text, const std::string& file) {
          return waitpoint::scenario::parameter_value(waitpoint::scenario::parse_yaml(text, file));
        }};
    ros1::Launch launch;
    read_launch_file({.file = folder.file("a.launch", contents), .arguments = {{"given", "1"}}, .written = {"s", 1}},
                     surroundings, launch);
    settle_conditions(launch);
  });
  return 0;
}
