// SPDX-License-Identifier: BSD-3-Clause
#include "tools/nodes/bag_summary.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "core/printable_line.hpp"

namespace waitpoint::tools {
namespace {

using nodes::BagResult;

/// Identity of a file's version, which changes when it is written anew; empty: there is no file.
std::string state_of(const std::string& file) {
  struct stat state {};
  if (stat(file.c_str(), &state) != 0) return "";
  return fmt::format("{} {} {} {}", state.st_ino, state.st_size, state.st_mtim.tv_sec, state.st_mtim.tv_nsec);
}

std::string in_words(BagResult::End end) {
  switch (end) {
    case BagResult::End::idle: return "nodes were idle";
    case BagResult::End::latest: return "nodes still published";
    case BagResult::End::nodes_ended: return "all nodes ended";
    case BagResult::End::required_ended: return "a required node ended";
    case BagResult::End::limit: return "the time limit was reached";
    case BagResult::End::interrupted: return "interrupted";
  }
  return "";
}

std::string count(std::size_t number, const std::string& one) {
  return fmt::format("{} {}{}", number, one, number == 1 ? "" : "s");
}

template <class Topics, class MessagesOf>
std::string head_of_topics(const char* title, const Topics& topics, MessagesOf messages_of) {
  std::uint64_t messages = 0;
  for (const auto& topic : topics) messages += messages_of(topic);
  return fmt::format("  {:<17} {} to {}\n", title, count(messages, "message"), count(topics.size(), "topic"));
}

}  // namespace

NodeOutputs::NodeOutputs(const std::vector<std::string>& names) : names_(names) {
  states_.reserve(names.size());
  for (const std::string& name : names) states_.push_back(state_of(name));
}

std::vector<NodeOutputs::File> NodeOutputs::read() const {
  std::vector<File> files;
  files.reserve(names_.size());
  for (std::size_t i = 0; i < names_.size(); ++i) {
    File& file = files.emplace_back(File{.name = names_[i], .bytes = 0, .digest = std::nullopt});
    const std::string state = state_of(file.name);
    if (state.empty() || state == states_[i]) continue;
    std::ifstream stream(file.name, std::ios::binary);
    const std::string contents{std::istreambuf_iterator<char>(stream), {}};
    file.bytes = contents.size();
    file.digest.emplace().add(std::string_view(contents));
  }
  return files;
}

std::string bag_summary(const scenario::Scenario& scenario, std::uint64_t seed, const BagResult& result,
                        const std::vector<NodeOutputs::File>& files) {
  std::size_t width = 0;
  for (const auto& topic : result.topics) width = std::max(width, topic.topic.size());
  for (const auto& [name, heard] : result.heard) width = std::max(width, name.size());
  for (const auto& file : files) width = std::max(width, file.name.size());
  Digest all;
  std::string text =
      fmt::format("{}, seed {}: {:.1f} s of {} played{}; {} after {:.1f} s simulated\n\n", scenario.name, seed,
                  result.played.seconds(), printable_line(scenario.play->bag.filename().string()),
                  result.is_played ? "" : ", not to its end", in_words(result.end), result.simulated.seconds());
  const auto line = [&](const std::string& name, const std::string& values) {
    text += fmt::format("    {:<{}}  {}\n", printable_line(name), width, values);
    all.add(std::string_view(name));
    all.add(std::string_view(values));
  };
  text += head_of_topics("played", result.topics, [](const auto& topic) { return topic.messages; });
  for (const auto& topic : result.topics) line(topic.topic, std::to_string(topic.messages));
  if (scenario.play->hears)
    text += head_of_topics("published", result.heard, [](const auto& topic) { return topic.second.messages; });
  for (const auto& [name, heard] : result.heard)
    line(name, fmt::format("{}, {}", heard.messages, to_string(heard.digest)));
  if (!files.empty()) text += "  written\n";
  for (const NodeOutputs::File& file : files)
    line(file.name, file.digest ? fmt::format("{} bytes, {}", file.bytes, to_string(*file.digest)) : "nothing");
  if (result.faults > 0) text += fmt::format("  faults of nodes   {}\n", result.faults);
  for (const std::string& warning : scenario.warnings) text += fmt::format("\nwarning: {}\n", warning);
  return text + fmt::format("\n  digest            {}\n", to_string(all));
}

}  // namespace waitpoint::tools
