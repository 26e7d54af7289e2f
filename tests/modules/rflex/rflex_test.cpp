// SPDX-License-Identifier: BSD-3-Clause
#include "modules/rflex/rflex.hpp"

#include <gtest/gtest.h>

#include <atomic>

#include "modules/genom/client.hpp"
#include "tests/modules/on_threads.hpp"

namespace waitpoint::rflex {
namespace {

// A module whose position is set next would otherwise take the step between frames for a motion.
TEST(SetPos, IsSeenInTheOdometryWhenItsReplyComes) {
  on_threads([] {
    genom::NameSpace names;
    genom::ModuleSetup setup{names, "rflex", genom::Settings()};
    Rflex rflex(setup);
    auto& controller = names.create_poster<posters::BaseReading>("rflex.reading", "the test");
    const auto& poster = dynamic_cast<genom::Poster<posters::Odometry>&>(*names.find_poster("rflex.odometry"));
    rflex.connect();
    rflex.start();
    posters::BaseReading reading;
    reading.date = threads::now();
    controller.write(reading);
    posters::Odometry odometry;
    while (poster.read(odometry) == genom::PosterStatus::empty)
      threads::this_thread::sleep_for(std::chrono::milliseconds(1));
    EXPECT_EQ(odometry.position.pose, Pose());
    genom::Client client(names, "client");
    for (const Pose pose : {Pose{20, 4, 1.5}, Pose{1, 2, -1}}) {
      posters::KnownPose known;
      known.pose = pose;
      EXPECT_EQ(client.call("rflex", "SetPos", known).report, genom::ok);
      poster.read(odometry);
      EXPECT_EQ(odometry.position.pose, pose);
    }
    EXPECT_TRUE(client.end_module("rflex"));
    rflex.join();
  });
}

TEST(MonitorBumpers, EndsWithThePanelThatIsPressed) {
  on_threads([] {
    genom::NameSpace names;
    genom::ModuleSetup setup{names, "rflex", genom::Settings()};
    Rflex rflex(setup);
    names.create_poster<posters::BaseReading>("rflex.reading", "the test");
    auto& bumper = names.create_poster<world::Bumpers::Reading>("rflex.bumper_reading", "the test");
    rflex.connect();
    rflex.start();
    bumper.write({threads::now(), 0});
    threads::thread wall([&] {
      threads::this_thread::sleep_for(std::chrono::milliseconds(100));
      bumper.write({threads::now(), 1u << 5});
    });
    genom::Client client(names, "client");
    const Time asked = threads::now();
    const genom::Reply reply = client.call("rflex", "MonitorBumpers", genom::Nothing());
    EXPECT_EQ(reply.report, genom::ok);
    EXPECT_EQ(reply.output.as<world::Bumpers::Reading>().pressed, 1u << 5);
    EXPECT_GE(threads::now() - asked, Duration(std::chrono::milliseconds(100)));
    wall.join();
    EXPECT_TRUE(client.end_module("rflex"));
    rflex.join();
  });
}

TEST(CalibrateGyro, FailsWithoutAGyroAndWhereTheRobotMoves) {
  on_threads([] {
    genom::NameSpace names;
    genom::ModuleSetup setup{names, "rflex", genom::Settings({{"gyro_calibration_ms", "200", "", 0}})};
    Rflex rflex(setup);
    auto& controller = names.create_poster<posters::BaseReading>("rflex.reading", "the test");
    auto& imu = names.create_poster<world::Imu::Reading>("rflex.imu_reading", "the test");
    rflex.connect();
    rflex.start();
    genom::Client client(names, "client");
    const auto calibrated = [&] { return client.call("rflex", "CalibrateGyro", genom::Nothing()); };
    EXPECT_EQ(genom::code_of(calibrated().report), static_cast<std::uint16_t>(CalibrationReport::no_gyro));
    std::atomic<bool> turning = false, done = false;
    threads::thread devices([&] {
      const Time started = threads::now();
      for (std::uint64_t i = 1; !done; ++i) {
        world::Imu::Reading sample;
        sample.date = threads::now();
        sample.number = i;
        sample.turned_rad = 0.02 * (sample.date - started).seconds();
        imu.write(sample);
        posters::BaseReading reading;
        reading.date = sample.date;
        reading.turn_units = turning ? static_cast<std::int64_t>(i) : 0;
        controller.write(reading);
        threads::this_thread::sleep_for(std::chrono::milliseconds(20));
      }
    });
    threads::this_thread::sleep_for(std::chrono::milliseconds(200));
    const genom::Reply reply = calibrated();
    EXPECT_EQ(reply.report, genom::ok);
    EXPECT_NEAR(reply.output.as<GyroBias>().rad_s, 0.02, 1e-9);
    turning = true;
    EXPECT_EQ(genom::code_of(calibrated().report), static_cast<std::uint16_t>(CalibrationReport::moved));
    done = true;
    devices.join();
    EXPECT_TRUE(client.end_module("rflex"));
    rflex.join();
  });
}

}  // namespace
}  // namespace waitpoint::rflex
