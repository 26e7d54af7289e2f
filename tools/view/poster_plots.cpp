// SPDX-License-Identifier: BSD-3-Clause
#include "tools/view/poster_plots.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "tools/view/view_json.hpp"

namespace waitpoint::tools::view {
namespace {

void add_paths(const FieldShape& shape, const std::string& prefix, std::vector<std::string>& paths) {
  if (shape.kind == FieldShape::Kind::list) return;
  if (shape.kind == FieldShape::Kind::value) {
    paths.push_back(prefix);
    return;
  }
  for (const FieldShape& part : shape.parts)
    add_paths(part, prefix.empty() ? part.name : prefix + "." + part.name, paths);
}

}  // namespace

std::vector<std::string> number_paths(const FieldShape& shape) {
  std::vector<std::string> paths;
  add_paths(shape, "", paths);
  return paths;
}

PosterPlots::PosterPlots(const run::Experiment& experiment) {
  for (std::size_t i = 0; i < experiment.robots().size(); ++i)
    for (const auto& [name, poster] : experiment.robots()[i]->names().posters()) {
      OfPoster of_poster{i, poster.get(), {}, {}};
      for (std::string& path : number_paths(poster->shape()))
        if (poster->has_number(path)) of_poster.readings.push_back({std::move(path)});
      of_poster.values.resize(of_poster.readings.size());
      size_ += of_poster.readings.size();
      if (!of_poster.readings.empty()) posters_.push_back(std::move(of_poster));
    }
}

void PosterPlots::take(Time now) {
  times_.push_back(now.ns());
  for (OfPoster& of_poster : posters_) {
    Time date;
    const bool is_written = of_poster.poster->look_numbers(of_poster.readings, date) == genom::PosterStatus::ok;
    for (std::size_t i = 0; i < of_poster.readings.size(); ++i) {
      const FieldReading& reading = of_poster.readings[i];
      const bool is_number = is_written && reading.outcome == FieldOutcome::number;
      of_poster.values[i].push_back(is_number ? static_cast<float>(reading.number)
                                              : std::numeric_limits<float>::quiet_NaN());
    }
  }
}

std::string PosterPlots::text() const {
  std::string text = "\"plot_times\":[";
  for (std::size_t i = 0; i < times_.size(); ++i) text += (i > 0 ? "," : "") + std::to_string(times_[i]);
  text += "],\"plots\":[";
  bool any = false;
  for (const OfPoster& of_poster : posters_)
    for (std::size_t i = 0; i < of_poster.readings.size(); ++i) {
      text += std::exchange(any, true) ? "," : "";
      const Json names = {
          {"robot", of_poster.robot}, {"poster", of_poster.poster->name()}, {"field", of_poster.readings[i].path}};
      text += text_of(names);
      text.back() = ',';
      text += "\"v\":[";
      for (std::size_t k = 0; k < of_poster.values[i].size(); ++k) {
        if (k > 0) text += ',';
        const float value = of_poster.values[i][k];
        text += std::isfinite(value) ? fmt::format("{:.6g}", value) : "null";
      }
      text += "]}";
    }
  return text + "]";
}

}  // namespace waitpoint::tools::view
