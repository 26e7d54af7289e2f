// SPDX-License-Identifier: BSD-3-Clause
#include "core/doing.hpp"

#include <atomic>
#include <utility>

namespace waitpoint {
namespace {

constinit thread_local const char* in_force = nullptr;
std::atomic<std::uint64_t> texts = 0;

}  // namespace

Doing::Doing(const char* text) : outer_(std::exchange(in_force, text)) { ++texts; }
Doing::~Doing() { in_force = outer_; }

const char* Doing::present() { return in_force; }
std::uint64_t Doing::count() { return texts; }

}  // namespace waitpoint
