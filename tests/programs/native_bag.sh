#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# The mapper on a bag as users have it, in real time: native_bag.sh MAPPER BAG IMAGE. A master of its own at a free port.
set -eu
mapper=$1 bag=$2 image=$3
port=$(/usr/bin/python3 -c 'import socket; one = socket.socket(); one.bind(("127.0.0.1", 0)); print(one.getsockname()[1])')
export ROS_MASTER_URI=http://127.0.0.1:$port/ ROS_IP=127.0.0.1 ROS_LOG_DIR="$(dirname "$image")/log"
rm -f "$image"
rosmaster --core -p "$port" >/dev/null 2>&1 &
master=$!
trap 'kill $master; wait' EXIT
sleep 2
"$mapper" scan:=/rackham/laser odom:=/rackham/odometry _file:="$image" >/dev/null &
node=$!
sleep 1
/usr/lib/rosbag/play -q --topics /rackham/laser /rackham/odometry --bags "$bag" </dev/null >/dev/null
sleep 1
kill -INT $node
wait $node || true
