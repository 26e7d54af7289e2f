// SPDX-License-Identifier: BSD-3-Clause
#include "tools/record/recording.hpp"

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
  if (failure_ != nullptr) std::rethrow_exception(failure_);
  commit(result);
}

}  // namespace waitpoint::tools
