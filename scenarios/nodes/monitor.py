#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Reads the posters of the robot's modules as topics, and tells at its end what it has seen."""

import collections
import math

import rospy
from geometry_msgs.msg import PoseWithCovarianceStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import LaserScan

counts = collections.Counter()
truths = collections.deque(maxlen=20)
worst = 0.0


def count(name):
    return lambda _: counts.update([name])


def take_position(position):
    global worst
    counts.update(["positions"])
    if not truths:
        return
    stamp = position.header.stamp.to_sec()
    truth = min(truths, key=lambda one: abs(one.header.stamp.to_sec() - stamp))
    if abs(truth.header.stamp.to_sec() - stamp) > 0.015:
        return
    here, there = position.pose.pose.position, truth.pose.pose.position
    worst = max(worst, math.hypot(here.x - there.x, here.y - there.y))


rospy.init_node("monitor")
rospy.Subscriber("base_pose_ground_truth", Odometry, truths.append)
rospy.Subscriber("pom/position", PoseWithCovarianceStamped, take_position)
rospy.Subscriber("rflex/odometry", Odometry, count("odometries"))
rospy.Subscriber("sick/echoes", LaserScan, count("scans"))
rospy.spin()
print(f"monitor: {counts['positions']} positions, {counts['odometries']} odometries, {counts['scans']} scans, "
      f"the position at most {worst:.2f} m off", flush=True)
