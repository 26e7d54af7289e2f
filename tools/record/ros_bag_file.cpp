// SPDX-License-Identifier: BSD-3-Clause
#include "tools/record/ros_bag_file.hpp"

#include <console_bridge/console.h>
#include <rosbag/bag.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "modules/messages/roscpp_traits.hpp"

namespace waitpoint::tools {
namespace {

// A bag that could not be written or closed is leaked: its destructor would write again, to a file that may be closed
// already, and throw. At the end of the process, ROS's loader of plugins would warn of an object that the bag holds.
struct Bag {
  rosbag::Bag* bag = new rosbag::Bag;

  Bag() = default;
  Bag(const Bag&) = delete;
  Bag& operator=(const Bag&) = delete;
  ~Bag() {
    try {
      if (bag != nullptr) call([](rosbag::Bag& open) { open.close(); });
    } catch (const std::runtime_error&) {
    }
    delete bag;
  }

  /// The library's exceptions do not name the system's error.
  template <class Call>
  void call(Call make_call) {
    rosbag::Bag* const called = std::exchange(bag, nullptr);
    if (called == nullptr) throw std::runtime_error("an earlier error");
    errno = 0;
    try {
      make_call(*called);
    } catch (const std::exception& failure) {
      const int reason = errno;
      console_bridge::setLogLevel(console_bridge::CONSOLE_BRIDGE_LOG_NONE);
      throw std::runtime_error(reason != 0 ? std::strerror(reason) : failure.what());
    }
    bag = called;
  }
};

class WrittenBag final : public RosBagFile {
 public:
  explicit WrittenBag(const std::string& path) : path_(path) {
    bag_.call([&](rosbag::Bag& bag) { bag.open(path, rosbag::bagmode::Write); });
  }

  void write(const std::string& topic, const messages::Stamp& received, const messages::Ros1Type& type,
             std::string_view bytes) override {
    const ros::Time time = std::max(ros::Time(received.sec, received.nsec), ros::TIME_MIN);
    bag_.call([&](rosbag::Bag& bag) { bag.write(topic, time, messages::SerializedMessage{&type, bytes}); });
  }
  void close() override;

 private:
  std::string path_;
  Bag bag_;
};

void WrittenBag::close() {
  bag_.call([](rosbag::Bag& bag) { bag.close(); });
  // The library overlooks failures of ftello(), after which its index points elsewhere.
  try {
    Bag written;
    written.call([&](rosbag::Bag& bag) { bag.open(path_, rosbag::bagmode::Read); });
    written.call([](rosbag::Bag& bag) { bag.close(); });
  } catch (const std::runtime_error&) {
    throw std::runtime_error("its index cannot be read back");
  }
}

std::unique_ptr<RosBagFile> make(const std::string& path) { return std::make_unique<WrittenBag>(path); }

}  // namespace
}  // namespace waitpoint::tools

extern "C" [[gnu::visibility("default")]] const waitpoint::tools::BagLibrary waitpoint_bag_library_2 = {
    .make = &waitpoint::tools::make};
