// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command/options/results.hpp"

#include <algorithm>
#include <iterator>
#include <string_view>

#include "tools/command/option_values.hpp"

namespace waitpoint::tools {
namespace {

/// A picture's format does not follow from its name: a viewer would take it for another.
void check_picture(const std::string& source, const std::string& name) {
  constexpr std::string_view others[] = {".png", ".jpg",  ".jpeg", ".gif", ".webp", ".bmp",
                                         ".tif", ".tiff", ".ppm",  ".pdf", ".ps",   ".eps"};
  std::string kind = std::filesystem::path(name).extension();
  std::ranges::transform(kind, kind.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  if (std::ranges::find(others, kind) != std::end(others))
    refuse(source, "a name that ends in .svg, the format of pictures", name);
}

}  // namespace

void declare_summary(Command& command, OptionalFile& summary, bool& json) {
  command.section("Results");
  command.add("--summary", written_file(summary, "FILE.json"),
              "write the summary as JSON; -: to standard output, in place of the text");
  command.json(json);
}

void declare_picture(Command& command, OptionalFile& picture, const char* description, const char* former) {
  OptionValue value = written_file(picture, "FILE.svg");
  value.take = [&picture](const std::string& source, const std::string& text) {
    check_picture(source, text);
    picture = text;
  };
  command.add("--picture", std::move(value), description, {.former = former});
}

void declare_event_files(Command& command, OptionalFile& digests, const char* of, OptionalFile& events) {
  command.add("--digests", written_file(digests, "FILE"), of);
  command.add("--events", written_file(events, "FILE"), "write every event as a line of text");
}

void declare_trace(Command& command, OptionalFile& trace, const char* description) {
  command.add("--trace", written_file(trace, "FILE.json"), description);
}

void declare_verify(Command& command, bool& verify, std::vector<std::string> files) {
  command.add(
      "--verify", flag(verify), "verify that it repeats: run three times and compare event by event",
      {.more = "It runs twice in this process and once in a perturbed one (addresses, memory, environment, clocks, "
               "directories); the first difference is reported, with status 1 (docs/determinism.md).",
       .former = "--check"});
  command.rules.push_back({"--verify", Rule::Kind::excludes, std::move(files)});
}

}  // namespace waitpoint::tools
