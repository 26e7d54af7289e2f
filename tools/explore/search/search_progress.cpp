// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/search/search_progress.hpp"
#include "core/number_text.hpp"

#include <fmt/format.h>

namespace waitpoint::tools {
namespace {

constexpr double redraw_s = 0.2;

}  // namespace

SearchProgress::SearchProgress(std::FILE* stream, bool terminal, Progress::Clock clock)
    : stream_(stream), terminal_(terminal), clock_(clock), start_s_(clock()), next_s_(start_s_ + progress_after_s) {}

bool SearchProgress::due() {
  const double now_s = clock_();
  if (!terminal_ || now_s < next_s_) return false;
  next_s_ = now_s + redraw_s;
  return true;
}

void SearchProgress::show(const std::string& words) {
  fmt::print(stream_, "\r\x1b[K{}", words);
  std::fflush(stream_);
  shown_ = true;
}

void SearchProgress::tell() {
  if (!heard_ || clock_() < next_told_s_) return;
  next_told_s_ = clock_() + redraw_s;
  news_.seconds = seconds();
  heard_(news_);
}

void SearchProgress::update(std::uint64_t schedules, std::uint64_t distinct, std::uint64_t failures) {
  news_ = {schedules, distinct, failures};
  tell();
  if (!due()) return;
  const double elapsed_s = seconds();
  show(fmt::format("{}, {:.1f} a second, {} distinct, {} failed", counted(schedules, "schedule"),
                   elapsed_s > 0 ? static_cast<double>(schedules) / elapsed_s : 0, distinct, failures));
}

void SearchProgress::update(const std::string& words) {
  news_.words = words;
  tell();
  if (due()) show(words);
}

void SearchProgress::finish() {
  if (shown_) fmt::print(stream_, "\r\x1b[K");
  shown_ = false;
}

}  // namespace waitpoint::tools
