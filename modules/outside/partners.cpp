// SPDX-License-Identifier: BSD-3-Clause
#include "modules/outside/partners.hpp"

namespace waitpoint::outside {

void Partners::begin(Host& host) {
  for (const auto& partner : partners_) partner->begin(host);
}

void Partners::publish(Host& host) {
  for (const auto& partner : partners_) partner->publish(host);
}

void Partners::take_in(Host& host) {
  for (const auto& partner : partners_) partner->take_in(host);
}

std::vector<std::string> Partners::accounts() const {
  std::vector<std::string> lines;
  for (const auto& partner : partners_) lines.push_back(partner->account());
  return lines;
}

std::vector<std::string> Partners::unmet() const {
  std::vector<std::string> all;
  for (const auto& partner : partners_)
    for (std::string& line : partner->unmet()) all.push_back(std::move(line));
  return all;
}

}  // namespace waitpoint::outside
