// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/report/place_text.hpp"

#include <utility>

#include "fibers/sync/report/source_lines.hpp"

namespace waitpoint::exploration {

std::vector<std::string> with_lines(const std::vector<ChoiceText>& texts) {
  std::vector<sync::CodePlaces> places;
  for (const ChoiceText& text : texts)
    if (!text.place.module.empty()) places.push_back({text.place});
  std::vector<std::vector<std::string>> lines;
  if (!places.empty()) lines = sync::user_source_lines(places, 1);
  std::vector<std::string> told;
  std::size_t next = 0;
  for (const ChoiceText& text : texts) {
    told.push_back(text.words);
    if (text.place.module.empty()) continue;
    const std::vector<std::string>& calls = lines[next++];
    if (!calls.empty()) told.back() += " at " + calls.front();
  }
  return told;
}

std::vector<Told> with_lines(std::vector<Told> told) {
  std::vector<ChoiceText> texts;
  texts.reserve(told.size());
  for (const Told& choice : told) texts.push_back({choice.words, choice.place});
  std::vector<std::string> words = with_lines(texts);
  for (std::size_t i = 0; i < told.size(); ++i) told[i].words = std::move(words[i]);
  return told;
}

}  // namespace waitpoint::exploration
