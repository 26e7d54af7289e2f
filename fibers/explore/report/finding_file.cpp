// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/report/finding_file.hpp"

#include <algorithm>
#include <string_view>

#include "fibers/explore/report/json_text.hpp"
#include "fibers/kernel/operation.hpp"

namespace waitpoint::exploration {
namespace {

void append_text(std::string& text, const char* name, std::string_view value) {
  text += (text.ends_with('{') ? "" : ",") + json_text(name) + ":" + json_text(value);
}

std::string operations() {
  std::string names;
  for (int i = 0; i <= static_cast<int>(kernel::Operation::call); ++i)
    names += (i > 0 ? "," : "") + json_text(kernel::name(static_cast<kernel::Operation>(i)));
  return "[" + names + "]";
}

std::string header_without_floor(const FindingFile& finding) {
  std::string text = "{";
  append_text(text, "kind", "header");
  append_text(text, "scenario", finding.title);
  text += ",\"seed\":" + std::to_string(finding.seed);
  append_text(text, "order", "explored");
  append_text(text, "program", finding.version);
  return text + ",\"until\":0,\"bounds\":[0,0,0,0],\"operations\":" + operations() +
         ",\"obstacles\":[],\"robots\":[],\"control\":false}";
}

// "function at file:line" in its parts; a call without a place is a function alone.
std::string frame(std::string_view call) {
  std::string text = "{";
  const std::size_t at = call.rfind(" at "), colon = call.rfind(':');
  const std::string_view line =
      colon != std::string_view::npos && at != std::string_view::npos && colon > at ? call.substr(colon + 1) : "";
  const bool is_number = !line.empty() && std::ranges::all_of(line, [](char c) { return c >= '0' && c <= '9'; });
  append_text(text, "function", is_number ? call.substr(0, at) : call);
  append_text(text, "file", is_number ? call.substr(at + 4, colon - at - 4) : "");
  return text + ",\"line\":" + (is_number ? std::string(line) : "0") + "}";
}

void append_marks(std::string& text, int line, const FindingSchedule& schedule) {
  for (std::size_t pair = 0; pair < schedule.pair.size(); ++pair) {
    const std::optional<FindingEvent>& event = schedule.pair[pair];
    if (!event) continue;
    std::string mark = "{\"line\":" + std::to_string(line) + ",\"pair\":" + std::to_string(pair);
    append_text(mark, "words", event->words);
    std::string frames;
    for (const std::string& call : event->calls) frames += (frames.empty() ? "" : ",") + frame(call);
    text.append(text.empty() ? "" : ",").append(mark).append(",\"frames\":[").append(frames).append("]}");
  }
}

void append_schedule(std::string& text, const char* name, const FindingSchedule& schedule) {
  append_text(text, "name", name);
  text += ",\"events\":" + schedule.events + ",\"frames\":[" + schedule.frames + "]";
}

}  // namespace

std::string to_text(const FindingFile& finding) {
  std::string told = "{\"format\":1";
  append_text(told, "schedule", finding.schedule);
  append_text(told, "failure", finding.failure);
  append_text(told, "choice", finding.choice);
  append_text(told, "note", finding.note);
  append_text(told, "replay", finding.replay);
  append_text(told, "debug", finding.debug);
  append_text(told, "steps", finding.steps);
  append_text(told, "report", finding.report);
  std::string text = "{\"finding\":" + told + "}";
  text += ",\"header\":" + (finding.scene.empty() ? header_without_floor(finding) : finding.scene);
  append_schedule(text, "fails", finding.fails);
  std::string others, marks;
  append_marks(marks, 0, finding.fails);
  if (finding.passes) {
    others = "{";
    append_schedule(others, "passes", *finding.passes);
    others += "}";
    append_marks(marks, 1, *finding.passes);
  }
  text += ",\"others\":[" + others + "],\"marks\":[" + marks + "]";
  append_text(text, "outcome", "failed");
  append_text(text, "summary", finding.report);
  return text + "}\n";
}

}  // namespace waitpoint::exploration
