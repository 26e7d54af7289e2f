// SPDX-License-Identifier: BSD-3-Clause
#include "tools/record/recording.hpp"

#include "core/error.hpp"

namespace waitpoint::tools {

void Recording::observe(const run::Experiment& experiment, Time now) {
  if (failure_ != nullptr) return;
  try {
    record(experiment, now);
  } catch (...) {
    failure_ = std::current_exception();
  }
}

void Recording::finish(const bridge::RunResult& result) {
  // A library's own exceptions, too, mean that the file cannot be written.
  try {
    if (failure_ != nullptr) std::rethrow_exception(failure_);
    commit(result);
  } catch (const BadInput&) {
    throw;
  } catch (const std::exception& failure) {
    throw BadInput(path_.string(), std::string("cannot be written: ") + failure.what());
  }
}

}  // namespace waitpoint::tools
