// SPDX-License-Identifier: BSD-3-Clause
#include "tools/output/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace waitpoint::tools {
namespace {

constexpr double redraw_s = 0.1;
constexpr int bar_width = 32;

void put(std::FILE* stream, const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stream);
  std::fflush(stream);
}

std::string goals_text(std::size_t goals_reached, std::size_t goals) {
  return goals == 0 ? "" : fmt::format("  {} of {} goals", goals_reached, goals);
}

}  // namespace

double wall_clock_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Progress::Progress(std::FILE* stream, bool terminal, Duration until, Clock clock)
    : stream_(stream),
      terminal_(terminal),
      until_(until),
      clock_(clock),
      start_s_(clock()),
      next_draw_s_(start_s_ + progress_after_s) {}

void Progress::update(Time now, std::size_t goals_reached, std::size_t goals) {
  if (!terminal_) return;
  const double wall_s = clock_();
  if (wall_s < next_draw_s_) return;
  next_draw_s_ = wall_s + redraw_s;
  draw_bar(now, goals_reached, goals, wall_s - start_s_);
}

void Progress::draw_bar(Time now, std::size_t goals_reached, std::size_t goals, double wall_s) {
  const double part = std::clamp(now.seconds() / until_.seconds(), 0.0, 1.0);
  const int full = static_cast<int>(part * bar_width);
  std::string bar;
  for (int i = 0; i < bar_width; ++i) bar += i < full ? "█" : "░";
  const std::string factor = wall_s > 0 ? fmt::format("  {:.1f} x real time", now.seconds() / wall_s) : "";
  put(stream_, fmt::format("\r\x1b[K{} {:.0f} s of {:.0f} s{}{}", bar, now.seconds(), until_.seconds(),
                           goals_text(goals_reached, goals), factor));
  bar_shown_ = true;
}

void Progress::log(Time now, std::string_view robot, std::string_view message) {
  finish();
  put(stream_, fmt::format("{:10.3f} s  {}: {}\n", now.seconds(), robot, message));
  next_draw_s_ = start_s_ + progress_after_s;
}

void Progress::finish() {
  if (bar_shown_) put(stream_, "\r\x1b[K");
  bar_shown_ = false;
}

}  // namespace waitpoint::tools
