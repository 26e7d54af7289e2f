// SPDX-License-Identifier: BSD-3-Clause
// The callback queue of given sources of roscpp. Before 1.13 these give Boost a count of microseconds with a fraction,
// which it no longer takes.
#include <ros/assert.h>
#include <ros/callback_queue.h>

#include <boost/scope_exit.hpp>

#define microseconds(count) microseconds(static_cast<long>(count))
#include CALLBACK_QUEUE
