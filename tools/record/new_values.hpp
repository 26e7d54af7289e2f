// SPDX-License-Identifier: BSD-3-Clause
// New values of one poster, for recordings.
#pragma once

#include <optional>
#include <string>

#include "modules/genom/name_space.hpp"

namespace waitpoint::tools {

/// One poster; if the robot does not have it, there are never new values.
template <class Value>
class NewValues {
 public:
  NewValues(const genom::NameSpace& names, const std::string& poster)
      : poster_(dynamic_cast<const genom::Poster<Value>*>(names.find_poster(poster))) {}

  /// The value, if its date differs from that of the last one taken.
  template <class DateOf>
  std::optional<Value> take(DateOf date_of) {
    std::optional<Value> value = poster_ != nullptr ? poster_->look() : std::nullopt;
    if (!value || (taken_ && *taken_ == date_of(*value))) return std::nullopt;
    taken_ = date_of(*value);
    return value;
  }

 private:
  const genom::Poster<Value>* poster_;
  std::optional<Time> taken_;
};

}  // namespace waitpoint::tools
