# SPDX-License-Identifier: BSD-3-Clause
"""A project that uses waitpoint: its source, and the commands that build it."""

import subprocess

OWN_HEADER = """
#pragma once
namespace own { constexpr int hours = 24; }
"""
MAIN = """
#include "core/time.hpp"
#include <waitpoint/core/time.hpp>
#include <waitpoint/fibers/explore/explore.hpp>
#include <waitpoint/fibers/sync/threads.hpp>
int main() {
  int written = 0;
  const auto report = waitpoint::explore([&] {
    written = 0;
    waitpoint::thread writer({.name = "writer"}, [&] { written = own::hours; });
    writer.join();
    waitpoint::check(written == own::hours);
  });
  return report.passed && written == own::hours ? 0 : 1;
}
"""


def run(*command, **options):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=1200, **options)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(map(str, command))}\nended with {done.returncode}:\n{done.stdout}{done.stderr}")


def write_consumer(folder):
    """Writes main.cpp, and a folder core/ of the project's own."""
    (folder / "core").mkdir()
    (folder / "core/time.hpp").write_text(OWN_HEADER)
    (folder / "main.cpp").write_text(MAIN)
