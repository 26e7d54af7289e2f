// SPDX-License-Identifier: BSD-3-Clause
#include "core/doing.hpp"

#include <utility>

namespace waitpoint {
namespace {

const char* innermost = nullptr;

}  // namespace

Doing::Doing(const char* text) : outer_(std::exchange(innermost, text)) {}
Doing::~Doing() { innermost = outer_; }

const char* Doing::present() { return innermost; }

}  // namespace waitpoint
