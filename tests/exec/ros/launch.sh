#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
#
# Starts ROS's master (in Python), a listener and a talker (in C++) from the folder FOLDER: launch.sh FOLDER PORT. The
# nodes find the master by trying again.
export ROS_MASTER_URI="http://127.0.0.1:$2" ROS_IP=127.0.0.1 ROS_LOG_DIR="$1/log"
rosmaster --core -p "$2" > /dev/null &
master=$!
"$1/listener" > "$1/heard" &
listener=$!
"$1/talker" > /dev/null
wait "$listener"
kill "$master"
wait "$master"
grep "^[0-9]*$" "$1/heard"  # without ROS's own lines
