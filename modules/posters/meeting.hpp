// SPDX-License-Identifier: BSD-3-Clause
// A rendezvous of two robots: the request to the module `meeting`, and the letter that the robots exchange.
#pragma once

#include <string_view>

#include "core/fields.hpp"

namespace waitpoint::posters {

/// The name of a robot or of a rendezvous, without a pointer.
struct ShortName {
  Bounded<char, 40> letters;

  ShortName() = default;
  /// Letters beyond the capacity are left out.
  explicit ShortName(std::string_view text) {
    for (const char letter : text.substr(0, letters.capacity())) letters.push_back(letter);
  }
  std::string_view text() const { return {letters.begin(), letters.size()}; }

  static void fields(auto field) { field("letters", &ShortName::letters); }
};

/// Input of Meet; and the letter by which a robot says that it is there, in which `robot` is the sender.
struct Meeting {
  ShortName robot;  ///< the other one
  ShortName name;   ///< of the rendezvous, the same for both

  static void fields(auto field) {
    field("robot", &Meeting::robot);
    field("name", &Meeting::name);
  }
};

}  // namespace waitpoint::posters
