#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Counts scans and goals, and tells at its end how near the robot came to anything."""

import rospy
from geometry_msgs.msg import PoseStamped
from std_msgs.msg import Float32

least, scans, goals = float("inf"), 0, 0


def take(nearest):
    global least, scans
    least, scans = min(least, nearest.data), scans + 1


def take_goal(_):
    global goals
    goals += 1


rospy.init_node("observer")
rospy.Subscriber("nearest", Float32, take)
rospy.Subscriber("move_base_simple/goal", PoseStamped, take_goal)
rospy.spin()
print(f"observer: {scans} scans, {goals} goals, nothing nearer than {least:.2f} m", flush=True)
