// SPDX-License-Identifier: BSD-3-Clause
// Messages of ROS's package sensor_msgs. Metres, radians, seconds.
#pragma once

#include "modules/messages/geometry_msgs.hpp"
#include "modules/messages/message.hpp"
#include "modules/messages/std_msgs.hpp"

namespace waitpoint::messages::sensor_msgs {

struct LaserScan {
  static constexpr std::string_view type_name = "sensor_msgs/LaserScan";
  std_msgs::Header header;
  float angle_min = 0;
  float angle_max = 0;
  float angle_increment = 0;
  float time_increment = 0;
  float scan_time = 0;
  float range_min = 0;
  float range_max = 0;
  std::vector<float> ranges;
  std::vector<float> intensities;
  static void fields(auto field) {
    field("header", &LaserScan::header);
    field("angle_min", &LaserScan::angle_min);
    field("angle_max", &LaserScan::angle_max);
    field("angle_increment", &LaserScan::angle_increment);
    field("time_increment", &LaserScan::time_increment);
    field("scan_time", &LaserScan::scan_time);
    field("range_min", &LaserScan::range_min);
    field("range_max", &LaserScan::range_max);
    field("ranges", &LaserScan::ranges);
    field("intensities", &LaserScan::intensities);
  }
};

struct Range {
  static constexpr std::string_view type_name = "sensor_msgs/Range";
  static constexpr Constant<std::uint8_t> constants[] = {{"ULTRASOUND", 0}, {"INFRARED", 1}};
  std_msgs::Header header;
  std::uint8_t radiation_type = 0;
  float field_of_view = 0;
  float min_range = 0;
  float max_range = 0;
  float range = 0;
  static void fields(auto field) {
    field("header", &Range::header);
    field("radiation_type", &Range::radiation_type);
    field("field_of_view", &Range::field_of_view);
    field("min_range", &Range::min_range);
    field("max_range", &Range::max_range);
    field("range", &Range::range);
  }
};

struct Imu {
  static constexpr std::string_view type_name = "sensor_msgs/Imu";
  std_msgs::Header header;
  geometry_msgs::Quaternion orientation;
  std::array<double, 9> orientation_covariance{};
  geometry_msgs::Vector3 angular_velocity;
  std::array<double, 9> angular_velocity_covariance{};
  geometry_msgs::Vector3 linear_acceleration;
  std::array<double, 9> linear_acceleration_covariance{};
  static void fields(auto field) {
    field("header", &Imu::header);
    field("orientation", &Imu::orientation);
    field("orientation_covariance", &Imu::orientation_covariance);
    field("angular_velocity", &Imu::angular_velocity);
    field("angular_velocity_covariance", &Imu::angular_velocity_covariance);
    field("linear_acceleration", &Imu::linear_acceleration);
    field("linear_acceleration_covariance", &Imu::linear_acceleration_covariance);
  }
};

struct BatteryState {
  static constexpr std::string_view type_name = "sensor_msgs/BatteryState";
  static constexpr Constant<std::uint8_t> constants[] = {{"POWER_SUPPLY_STATUS_UNKNOWN", 0},
                                                         {"POWER_SUPPLY_STATUS_CHARGING", 1},
                                                         {"POWER_SUPPLY_STATUS_DISCHARGING", 2},
                                                         {"POWER_SUPPLY_STATUS_NOT_CHARGING", 3},
                                                         {"POWER_SUPPLY_STATUS_FULL", 4},
                                                         {"POWER_SUPPLY_HEALTH_UNKNOWN", 0},
                                                         {"POWER_SUPPLY_HEALTH_GOOD", 1},
                                                         {"POWER_SUPPLY_HEALTH_OVERHEAT", 2},
                                                         {"POWER_SUPPLY_HEALTH_DEAD", 3},
                                                         {"POWER_SUPPLY_HEALTH_OVERVOLTAGE", 4},
                                                         {"POWER_SUPPLY_HEALTH_UNSPEC_FAILURE", 5},
                                                         {"POWER_SUPPLY_HEALTH_COLD", 6},
                                                         {"POWER_SUPPLY_HEALTH_WATCHDOG_TIMER_EXPIRE", 7},
                                                         {"POWER_SUPPLY_HEALTH_SAFETY_TIMER_EXPIRE", 8},
                                                         {"POWER_SUPPLY_TECHNOLOGY_UNKNOWN", 0},
                                                         {"POWER_SUPPLY_TECHNOLOGY_NIMH", 1},
                                                         {"POWER_SUPPLY_TECHNOLOGY_LION", 2},
                                                         {"POWER_SUPPLY_TECHNOLOGY_LIPO", 3},
                                                         {"POWER_SUPPLY_TECHNOLOGY_LIFE", 4},
                                                         {"POWER_SUPPLY_TECHNOLOGY_NICD", 5},
                                                         {"POWER_SUPPLY_TECHNOLOGY_LIMN", 6}};
  std_msgs::Header header;
  float voltage = 0;
  float temperature = 0;
  float current = 0;
  float charge = 0;
  float capacity = 0;
  float design_capacity = 0;
  float percentage = 0;
  std::uint8_t power_supply_status = 0;
  std::uint8_t power_supply_health = 0;
  std::uint8_t power_supply_technology = 0;
  bool present = false;
  std::vector<float> cell_voltage;
  std::vector<float> cell_temperature;
  std::string location;
  std::string serial_number;
  static void fields(auto field) {
    field("header", &BatteryState::header);
    field("voltage", &BatteryState::voltage);
    field("temperature", &BatteryState::temperature);
    field("current", &BatteryState::current);
    field("charge", &BatteryState::charge);
    field("capacity", &BatteryState::capacity);
    field("design_capacity", &BatteryState::design_capacity);
    field("percentage", &BatteryState::percentage);
    field("power_supply_status", &BatteryState::power_supply_status);
    field("power_supply_health", &BatteryState::power_supply_health);
    field("power_supply_technology", &BatteryState::power_supply_technology);
    field("present", &BatteryState::present);
    field("cell_voltage", &BatteryState::cell_voltage);
    field("cell_temperature", &BatteryState::cell_temperature);
    field("location", &BatteryState::location);
    field("serial_number", &BatteryState::serial_number);
  }
};

}  // namespace waitpoint::messages::sensor_msgs
