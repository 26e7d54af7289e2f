# SPDX-License-Identifier: BSD-3-Clause
"""How the programs with bugs that nobody had reported are built: docs/found.md. A mended library's sources are compiled into the
program, where they have precedence over Debian's library."""

from recipes import ROSCPP, TF2, Recipe, callback_queue, nng

BUG = "found.md"


def headers(sources, _folder):
    return [f"-I{sources}", f"-I{sources}/include"]


def poco(sources, _folder):
    return [f"-I{sources}/Foundation/include", *(sources / f"Foundation/src/{name}.cpp" for name in ("Timer", "ThreadPool"))]


def ignition_common(sources, _folder):
    return [sources / "src/WorkerPool.cc"]


# Libraries that Debian does not have: the sources, with the library in their folder `build`.
def rtt(sources, _folder):
    library = sources / "build/rtt"
    folders = (sources, library, f"{library}/os", f"{library}/os/gnulinux", f"{sources}/rtt/os/gnulinux")
    includes = [f"-I{folder}" for folder in folders]
    return ["-DOROCOS_TARGET=gnulinux", *includes, f"-L{library}", f"-Wl,-rpath,{library}"]


def yarp(sources, _folder):
    includes = [f"-I{sources}/{folder}src/libYARP_{part}/src" for folder in ("", "build/") for part in ("os", "conf")]
    return [*includes, f"-L{sources}/build/lib", f"-Wl,-rpath,{sources}/build/lib"]


POCO = ("PocoFoundation",)
RTT = ("orocos-rtt-gnulinux", "boost_filesystem", "boost_system", "boost_thread")

RECIPES = [
    Recipe("poco_activity_destroyed.cpp", BUG, "1.11.0", "libpoco-dev", POCO, poco),
    Recipe("poco_timer_stop.cpp", BUG, "1.11.0", "libpoco-dev", POCO, poco),
    Recipe("poco_timer_stopped_twice.cpp", BUG, "1.11.0", "libpoco-dev", POCO, poco),
    Recipe("poco_pool_destroyed.cpp", BUG, "1.11.0", "libpoco-dev", POCO, poco),
    Recipe("openthreads_readers.cpp", BUG, "3.6.5", "libopenthreads-dev", ("OpenThreads",), headers),
    Recipe("openthreads_block.cpp", BUG, "3.6.5", "libopenthreads-dev", ("OpenThreads",), headers),
    Recipe("nng_close_in_send.c", BUG, "1.5.2", "libnng-dev", ("nng",), nng),
    Recipe("tf2_filter_answered.cpp", BUG, "0.7.6", "libtf2-ros-dev", TF2, headers),
    Recipe("ignition_worker_pool.cpp", BUG, "4.5.1", "libignition-common-dev", ("ignition-common4",), ignition_common,
           options=("-I/usr/include/ignition/common4", "-I/usr/include/ignition/cmake2")),
    Recipe("roscpp_add_again.cpp", BUG, "1.15.15", "libroscpp-dev", ROSCPP, callback_queue),
    Recipe("boost_executor_destroyed.cpp", BUG, "1.74.0", "libboost-thread-dev", ("boost_thread", "boost_system"), headers),
    Recipe("rtt_activity_stop.cpp", BUG, "2.8.99", "", RTT, rtt, packaged=False),
    Recipe("rtt_timer_destroyed.cpp", BUG, "2.8.99", "", RTT, rtt, packaged=False),
    Recipe("rtt_timer_armed_again.cpp", BUG, "2.8.99", "", RTT, rtt, packaged=False),
    Recipe("yarp_timers.cpp", BUG, "3.9.0", "", ("YARP_os",), yarp, packaged=False),
    Recipe("yarp_event.cpp", BUG, "3.9.0", "", ("YARP_os",), yarp, packaged=False),
]
