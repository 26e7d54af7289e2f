/* SPDX-License-Identifier: BSD-3-Clause */
/* The types of this folder's posters and requests as C has them, for the descriptions of the modules. A list of bounded
 * length has its length first; a date and a duration are nanoseconds of virtual time. */
#ifndef POSTERS_STRUCT_H
#define POSTERS_STRUCT_H

#include <stdbool.h>
#include <stdint.h>

typedef int64_t DATE_NS;
typedef int64_t DURATION_NS;
typedef struct POINT { double x, y; } POINT;                /* m */
typedef struct POSE { double x, y, heading; } POSE;         /* m, rad */

/* base.hpp */
typedef struct BASE_COMMAND {
  double v_m_s, w_rad_s;
  bool sonars_on;
  double side_m_s, climb_m_s;
} BASE_COMMAND;
typedef struct BUMPERS {
  DATE_NS date;
  uint32_t pressed;
} BUMPERS;
typedef struct SPEED_REFERENCE {
  DATE_NS date;
  double v_m_s, w_rad_s;
  uint32_t number;
  double side_m_s, climb_m_s;
} SPEED_REFERENCE;
typedef struct BATTERY {
  DATE_NS date;
  double volts;
  bool low;
  double charge, current_a;
} BATTERY;
typedef struct SONAR_ECHO {
  POSE mount;
  double range_m;
} SONAR_ECHO;
typedef struct SONARS {
  DATE_NS date;
  struct { uint32_t size; SONAR_ECHO items[48]; } echoes;
} SONARS;

/* world/sensors/types/imu.hpp, gps.hpp */
typedef struct INERTIAL {
  DATE_NS date;
  uint64_t number;
  double turn_rad_s, ahead_m_s2, left_m_s2, up_m_s2, turned_rad;
} INERTIAL;
typedef struct POSITION_FIX {
  DATE_NS date;
  uint64_t number;
  POINT position;
  double height_m;
} POSITION_FIX;

/* laser.hpp */
typedef struct LASER_COMMAND { bool on; } LASER_COMMAND;
typedef struct LASER_READING {
  DATE_NS date;
  uint32_t number;
  double first_angle_rad, angle_step_rad, range_max_m;
  struct { uint32_t size; float items[721]; } range_m;
} LASER_READING;
typedef struct ECHOES {
  LASER_READING scan;
  POSE mount;
} ECHOES;
typedef struct SEGMENT {
  POINT start, end;
  double normal_rad, distance_m;
  double covariance[3];
  uint32_t points;
} SEGMENT;
typedef struct SEGMENTS {
  DATE_NS date;
  uint32_t number;
  struct { uint32_t size; SEGMENT items[64]; } items;
} SEGMENTS;
typedef struct MAP_SEGMENT { POINT start, end; } MAP_SEGMENT;
typedef struct SEGMENT_MAP {
  DATE_NS date;
  struct { uint32_t size; MAP_SEGMENT items[512]; } items;
} SEGMENT_MAP;

/* navigation.hpp */
typedef struct KNOWN_POSE {
  POSE pose;
  double position_deviation_m, heading_deviation_rad;
} KNOWN_POSE;
typedef struct GO_TO_INPUT {
  struct { uint32_t size; POINT items[48]; } via;
} GO_TO_INPUT;

/* position.hpp */
typedef struct POSITION_ESTIMATE {
  DATE_NS date;
  POSE pose;
  double covariance[9];
} POSITION_ESTIMATE;
typedef struct ODOMETRY {
  POSITION_ESTIMATE position;
  double v_m_s, w_rad_s;
  bool stalled;
  double height_m;
} ODOMETRY;
typedef struct LOCALISATION {
  POSITION_ESTIMATE position;
  uint32_t matched, observed;
  bool lost;
  uint32_t jumps;
} LOCALISATION;
typedef struct FUSED_POSITION {
  POSITION_ESTIMATE position;
  uint8_t state; /* 0 good, 1 uncertain, 2 sources disagree */
  DURATION_NS correction_age;
} FUSED_POSITION;

#endif
