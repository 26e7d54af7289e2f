// SPDX-License-Identifier: BSD-3-Clause
// Numbers in messages of any type, by the definition that comes with a connection: http://wiki.ros.org/msg.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace waitpoint::nodes {

class MessageLayout {
 public:
  /// `definition`: that of the type, with those of the types within, as roscpp has it.
  explicit MessageLayout(const std::string& definition);

  /// The number in this field of a serialized message; in seconds for a time or a duration, 0 or 1 for a bool. Elements
  /// of arrays are given as in "ranges[3]". Nothing if the message has no such field, or no number there.
  std::optional<double> value(const std::vector<std::uint8_t>& message, const std::string& field) const;

 private:
  struct Field {
    std::string type, name;
    bool is_array = false;
    std::optional<std::uint32_t> count = {};  // of an array of a fixed size
  };
  class Reading;

  const std::vector<Field>* fields_of(const std::string& type, const std::string& package) const;

  std::map<std::string, std::vector<Field>> types_;  // by full name; "" is the message's own
};

}  // namespace waitpoint::nodes
