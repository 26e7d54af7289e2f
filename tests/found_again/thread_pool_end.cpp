// SPDX-License-Identifier: BSD-3-Clause
// BS::thread_pool, issues 93 and 107: a pool without tasks is destroyed.
#include <BS_thread_pool_light.hpp>

int main() {
  BS::thread_pool_light pool(2);
  pool.wait_for_tasks();
}
