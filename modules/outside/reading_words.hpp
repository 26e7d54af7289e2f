// SPDX-License-Identifier: BSD-3-Clause
// A reading of a sensor as words KEY=VALUE, by its declared fields but the date: numbers, lists with commas, points as
// x,y; durations in seconds.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "core/fields.hpp"
#include "core/number_text.hpp"
#include "modules/scenario/words.hpp"

namespace waitpoint::outside {

/// The words KEY=VALUE of a line.
class Values {
 public:
  Values(std::string_view text, const scenario::Location& written) : written_(written) {
    for (std::string word = scenario::take_word(text, written); !word.empty();
         word = scenario::take_word(text, written))
      words_.push_back(std::move(word));
  }

  std::string_view text(std::string_view key) const {
    for (const std::string_view word : words_)
      if (word.size() > key.size() && word.starts_with(key) && word[key.size()] == '=')
        return word.substr(key.size() + 1);
    throw written_.bad("expected " + std::string(key) + "=VALUE");
  }
  std::vector<double> list(std::string_view key) const {
    std::vector<double> numbers;
    for (std::string_view rest = text(key); !rest.empty();) {
      const std::size_t comma = std::min(rest.find(','), rest.size());
      if (!parse_number(rest.substr(0, comma), numbers.emplace_back())) throw bad_number(key);
      rest.remove_prefix(std::min(comma + 1, rest.size()));
    }
    return numbers;
  }
  template <class Number>
  void read(std::string_view key, Number& number) const {
    if (!parse_number(text(key), number)) throw bad_number(key);
  }
  void read(std::string_view key, bool& is_set) const {
    int number = 0;
    read(key, number);
    is_set = number != 0;
  }
  void read(std::string_view key, Duration& duration) const {
    double seconds = 0;
    read(key, seconds);
    duration = Duration::from_seconds(seconds);
  }
  void read(std::string_view key, Point& point) const {
    const std::vector<double> numbers = list(key);
    if (numbers.size() != 2) throw bad_number(key);
    point = {numbers[0], numbers[1]};
  }
  template <class T, std::size_t N>
  void read(std::string_view key, Bounded<T, N>& items) const {
    const std::vector<double> numbers = list(key);
    if (numbers.size() > N)
      throw written_.bad("expected at most " + std::to_string(N) + " numbers of " + std::string(key));
    items.clear();
    for (const double number : numbers) items.push_back(static_cast<T>(number));
  }
  template <HasFields Reading>
  void read(Reading& reading) const {
    for_each_field(reading, [&](std::string_view key, auto& member) {
      if constexpr (!std::is_same_v<std::remove_cvref_t<decltype(member)>, Time>) read(key, member);
    });
  }

 private:
  BadInput bad_number(std::string_view key) const {
    return written_.bad("expected '" + std::string(key) + "' to be a number, found '" + std::string(text(key)) + "'");
  }

  std::vector<std::string> words_;
  const scenario::Location& written_;
};

template <HasFields Reading>
std::string words_of(const Reading& reading) {
  std::string words;
  for_each_field(reading, [&]<class T>(std::string_view key, const T& member) {
    if constexpr (std::is_same_v<T, Time>) return;
    words.append(" ").append(key).append("=");
    if constexpr (std::is_same_v<T, bool>)
      words += member ? "1" : "0";
    else if constexpr (std::is_arithmetic_v<T>)
      words += fmt::format("{}", member);
    else if constexpr (std::is_same_v<T, Duration>)
      words += fmt::format("{}", member.seconds());
    else if constexpr (std::is_same_v<T, Point>)
      words += fmt::format("{},{}", member.x, member.y);
    else if constexpr (!std::is_same_v<T, Time>)
      words += fmt::format("{}", fmt::join(member.begin(), member.end(), ","));
  });
  return words;
}

}  // namespace waitpoint::outside
