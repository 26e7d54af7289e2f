# SPDX-License-Identifier: BSD-3-Clause
"""How each program of this folder is built: with Debian's package of its library, or with sources of another version."""

import dataclasses
import pathlib
import subprocess
from collections.abc import Callable

HERE = pathlib.Path(__file__).resolve().parent


class CannotBuild(Exception):
    """Its text is one line for the user."""


@dataclasses.dataclass(frozen=True)
class Recipe:
    """`of_sources(SOURCES, FOLDER)` returns the compiler's options for a library in the folder SOURCES, which it may build in
    FOLDER. Without `packaged`, Debian's package does not have the bug, or there is none."""

    program: str
    bug: str
    version: str
    package: str
    libraries: tuple[str, ...]
    of_sources: Callable[[pathlib.Path, pathlib.Path], list]
    packaged: bool = True
    options: tuple[str, ...] = ()

    @property
    def name(self):
        return pathlib.Path(self.program).stem

    def uninstrumented(self):
        options = tuple(option for option in self.options if not option.startswith("-fsanitize"))
        return dataclasses.replace(self, options=options)


def run(*command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, errors="replace")
    if done.returncode != 0:
        errors = [line for line in (done.stderr + done.stdout).splitlines() if "error" in line or "undefined" in line]
        raise CannotBuild((errors or [f"{command[0]} failed"])[0])


def nng(sources, folder):
    run("cmake", "-S", sources, "-B", folder, "-DBUILD_SHARED_LIBS=ON", "-DNNG_TESTS=OFF", "-DNNG_TOOLS=OFF",
        "-DCMAKE_BUILD_TYPE=RelWithDebInfo")
    run("cmake", "--build", folder)
    return [f"-I{sources}/include", f"-L{folder}", f"-Wl,-rpath,{folder}"]


def callback_queue(sources, _folder):
    queue = sources / "clients/roscpp/src/libros/callback_queue.cpp"
    return [f'-DCALLBACK_QUEUE="{queue}"', HERE / "callback_queue_of_sources.cpp"]


def tf2(sources, _folder):
    # Early versions use names without a prefix, which console_bridge no longer has.
    names = [f"-Dlog{level}=CONSOLE_BRIDGE_log{level}" for level in ("Debug", "Inform", "Warn", "Error")]
    return [*names, f"-I{sources}/tf2/include", f"-I{sources}/tf2_ros/include", *sorted(sources.glob("tf2/src/*.cpp"))]


def installed(sources, _folder):
    """A library that was installed in a folder, such as a package of another version that dpkg has extracted there."""
    libraries = sources / "usr/lib/x86_64-linux-gnu"
    return [f"-I{sources}/usr/include", f"-L{libraries}", f"-Wl,--disable-new-dtags,-rpath,{libraries}"]


def thread_pool(sources, _folder):
    return [f"-I{sources}", f"-I{sources}/include"]


ROSCPP = ("roscpp", "rostime", "rosconsole", "boost_thread", "boost_chrono", "boost_system")
POCO = ("PocoUtil", "PocoFoundation")
TF2 = ("tf2_ros", "tf2", "message_filters", "roscpp_serialization", "console_bridge", *ROSCPP)

RECIPES = [
    Recipe("nng_close_in_receive.c", "nng #1543, #1813", "1.5.2", "libnng-dev", ("nng",), nng),
    Recipe("nng_close_after_message.c", "nng #1236", "1.3.0", "libnng-dev", ("nng",), nng, packaged=False),
    Recipe("tf2_filter_destroyed.cpp", "geometry2 #538", "0.7.6", "libtf2-ros-dev", TF2, tf2),
    Recipe("tf2_filter_full.cpp", "geometry2 #91, #144", "0.5.15", "libtf2-ros-dev", TF2, tf2, packaged=False),
    Recipe("roscpp_remove_in_call.cpp", "ros_comm #2283", "1.15.15", "libroscpp-dev", ROSCPP, callback_queue),
    Recipe("roscpp_remove_under_lock.cpp", "ros_comm #1980", "1.15.9", "libroscpp-dev", ROSCPP, callback_queue, packaged=False),
    Recipe("roscpp_first_callback.cpp", "ros_comm #1054", "1.12.7", "libroscpp-dev", ROSCPP, callback_queue, packaged=False),
    Recipe("thread_pool_end.cpp", "BS::thread_pool #93, #107", "3.3.0", "", (), thread_pool, packaged=False,
           options=("-fsanitize=thread",)),
    Recipe("poco_timer_cancel.cpp", "Poco #3921", "1.11.0", "libpoco-dev", POCO, installed),
    Recipe("poco_timer_end.cpp", "Poco #3986", "1.11.0", "libpoco-dev", POCO, installed),
    Recipe("poco_wake_up_all.cpp", "Poco #5213", "1.11.0", "libpoco-dev", POCO, installed),
    Recipe("poco_remove_observer.cpp", "Poco #4970", "1.11.0", "libpoco-dev", POCO, installed),
    Recipe("poco_async_close.cpp", "Poco #1039", "1.11.0", "libpoco-dev", POCO, installed),
    Recipe("poco_file_close.cpp", "Poco #2542", "1.11.0", "libpoco-dev", POCO, installed),
    Recipe("paho_cpp_callback.cpp", "paho.mqtt.cpp #356, #481", "1.2.0", "libpaho-mqttpp-dev", ("paho-mqttpp3", "paho-mqtt3as"),
           installed),
    Recipe("nanomsg_send_in_close.c", "nanomsg #894, #1040", "1.1.5", "libnanomsg-dev", ("nanomsg",), installed),
    Recipe("czmq_first_sockets.c", "CZMQ #2019, #2196", "4.2.1", "libczmq-dev", ("czmq", "zmq"), installed),
    Recipe("httplib_stop.cpp", "cpp-httplib #1371", "0.11.4", "libcpp-httplib-dev", ("cpp-httplib",), installed),
    Recipe("boost_interrupted_lock.cpp", "Boost.Thread #373", "1.74.0", "libboost-thread-dev",
           ("boost_thread", "boost_chrono", "boost_system"), installed),
    Recipe("std_semaphore.cpp", "GCC #104928", "12.2.0", "libstdc++-12-dev", (), installed,
           options=("-std=c++20", "-fsanitize=thread")),
]


def compiled(recipe, sources, folder):
    """The program in `folder`: with the library in `sources`, or with Debian's package."""
    program = folder / recipe.name
    language = ("gcc",) if recipe.program.endswith(".c") else ("g++", "-std=c++17")
    with_sources = recipe.of_sources(sources, folder / f"{recipe.name}-library") if sources else []
    run(*language, "-g", "-O1", "-w", "-pthread", f"-I{HERE.parent.parent}", *recipe.options, HERE / recipe.program, *with_sources,
        "-o", program, *(f"-l{library}" for library in recipe.libraries))
    return program
