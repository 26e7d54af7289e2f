// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fibers/explore/weak_memory/litmus.hpp"

#include <algorithm>

namespace waitpoint::weak_memory {
namespace {

const char* name(std::memory_order order) {
  switch (order) {
    case std::memory_order_relaxed: return "relaxed";
    case std::memory_order_consume: return "consume";
    case std::memory_order_acquire: return "acquire";
    case std::memory_order_release: return "release";
    case std::memory_order_acq_rel: return "acq_rel";
    case std::memory_order_seq_cst: return "seq_cst";
  }
  return "";
}

std::string text_of(const Step& step) {
  static constexpr const char* kinds[] = {"load", "store", "add", "exchange", "fence"};
  std::string text = kinds[static_cast<int>(step.kind)];
  if (step.kind == Step::Kind::fence) return text + " " + name(step.order);
  text += std::string(" ") + "xyz"[step.location];
  if (step.kind != Step::Kind::load) text += " " + std::to_string(step.value);
  return text + " " + name(step.order);
}

}  // namespace

bool is_final(const Litmus& litmus, int location) {
  std::ptrdiff_t stores = 0;
  for (const std::vector<Step>& thread : litmus)
    stores += std::count_if(thread.begin(), thread.end(),
                            [&](const Step& step) { return step.writes() && step.location == location; });
  return stores > 1;
}

std::string text_of(const Litmus& litmus) {
  std::string text;
  for (const std::vector<Step>& thread : litmus) {
    text += text.empty() ? "" : " | ";
    for (std::size_t i = 0; i < thread.size(); ++i) text += (i == 0 ? "" : "; ") + text_of(thread[i]);
  }
  return text;
}

std::string text_of(const Outcomes& outcomes) {
  std::string text;
  for (const Outcome& outcome : outcomes) {
    text += "(";
    for (std::size_t i = 0; i < outcome.size(); ++i) text += (i == 0 ? "" : ",") + std::to_string(outcome[i]);
    text += ") ";
  }
  return text;
}

}  // namespace waitpoint::weak_memory
