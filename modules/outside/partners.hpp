// SPDX-License-Identifier: BSD-3-Clause
// All partners of a run.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "modules/outside/partner.hpp"

namespace waitpoint::outside {

class Partners {
 public:
  void add(std::unique_ptr<Partner> partner) { partners_.push_back(std::move(partner)); }
  bool empty() const { return partners_.empty(); }

  void begin(Host& host);
  void publish(Host& host);
  void take_in(Host& host);
  std::vector<std::string> accounts() const;
  std::vector<std::string> unmet() const;

 private:
  std::vector<std::unique_ptr<Partner>> partners_;
};

}  // namespace waitpoint::outside
