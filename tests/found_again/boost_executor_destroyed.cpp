// SPDX-License-Identifier: BSD-3-Clause
// Boost.Thread (docs/found.md): an executor is destroyed while its work asks whether it is closed.
#define BOOST_THREAD_VERSION 4
#define BOOST_THREAD_PROVIDES_EXECUTORS
#include <boost/thread/executors/thread_executor.hpp>

int main() {
  boost::executors::thread_executor executor;
  executor.submit([&] { executor.closed(); });
}
