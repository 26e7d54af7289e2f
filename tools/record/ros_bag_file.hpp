// SPDX-License-Identifier: BSD-3-Clause
// The container of a ROS 1 bag, written by rosbag_storage in a library of its own, which is loaded by the first bag:
// programs that write none do not need ROS. Failures to write are std::runtime_error.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "modules/messages/description.hpp"

namespace waitpoint::tools {

class RosBagFile {
 public:
  virtual ~RosBagFile() = default;

  /// Adds a message in ROS 1's wire format, received at that time. Bags have no time 0: it becomes their least.
  virtual void write(const std::string& topic, const messages::Stamp& received, const messages::Ros1Type& type,
                     std::string_view bytes) = 0;
  virtual void close() = 0;
};

/// The library, loaded.
struct BagLibrary {
  static constexpr const char* file = "libwaitpoint-bags.so";
  static constexpr const char* symbol = "waitpoint_bag_library_2";  ///< with the version of this file

  /// Opens a bag to be written; std::runtime_error if that fails.
  std::unique_ptr<RosBagFile> (*make)(const std::string& path);
};

/// Loads the library; BadInput if it is not there, about the file `bag` that needs it.
const BagLibrary& bag_library(const std::string& bag);

}  // namespace waitpoint::tools
