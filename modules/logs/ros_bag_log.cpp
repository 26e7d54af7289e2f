// SPDX-License-Identifier: BSD-3-Clause
#include "modules/logs/ros_bag_log.hpp"

#include <map>

#include "modules/logs/decompression.hpp"
#include "modules/logs/topic_log.hpp"
#include "modules/messages/byte_reader.hpp"

namespace waitpoint::logs {
namespace {

constexpr std::string_view magic = "#ROSBAG V2.0\n";

enum : std::uint8_t { message_data = 2, bag_header = 3, index_data = 4, chunk = 5, chunk_info = 6, connection = 7 };

using Fields = std::map<std::string, std::string_view, std::less<>>;

struct Connection {
  std::string topic, type;
};

// Some recorders leave the slash out.
std::string global_name(std::string_view topic) { return (topic.starts_with('/') ? "" : "/") + std::string(topic); }

class BagParser {
 public:
  explicit BagParser(const std::string& name) : name_(name), topics_(name) {}

  void parse(std::string_view bytes, bool is_in_chunk) {
    ByteReader reader(name_, bytes);
    while (!reader.at_end()) {
      const Fields header = fields(reader.text());
      take(header, reader.text(), is_in_chunk);
    }
  }
  TopicLog& topics() { return topics_; }

 private:
  Fields fields(std::string_view bytes) const {
    Fields fields;
    for (ByteReader reader(name_, bytes); !reader.at_end();) {
      const std::string_view field = reader.text();
      const std::size_t equals = field.find('=');
      if (equals == field.npos) reader.reject("a field 'name=value' in a record of the bag");
      fields[std::string(field.substr(0, equals))] = field.substr(equals + 1);
    }
    return fields;
  }
  std::string_view field(const Fields& header, std::string_view key) const {
    const auto found = header.find(key);
    if (found == header.end())
      throw BadInput(name_, "expected a field '" + std::string(key) + "' in a record of the bag");
    return found->second;
  }
  template <class Number>
  Number number(const Fields& header, std::string_view key) const {
    return ByteReader(name_, field(header, key)).number<Number>();
  }

  Time time(const Fields& header) const {
    ByteReader bytes(name_, field(header, "time"));
    const auto sec = bytes.number<std::uint32_t>(), nsec = bytes.number<std::uint32_t>();
    return messages::time_of({sec, nsec});
  }

  void take(const Fields& header, std::string_view data, bool is_in_chunk) {
    switch (number<std::uint8_t>(header, "op")) {
      case chunk: {
        if (is_in_chunk) throw BadInput(name_, "expected no chunk in a chunk of the bag");
        const std::string_view method = field(header, "compression");
        if (method == "none") return parse(data, true);
        return parse(decompressed(name_, method, data), true);
      }
      case connection: {
        const Fields described = fields(data);
        connections_[number<std::uint32_t>(header, "conn")] = {global_name(field(header, "topic")),
                                                               std::string(field(described, "type"))};
        return;
      }
      case message_data: {
        const auto found = connections_.find(number<std::uint32_t>(header, "conn"));
        if (found == connections_.end()) throw BadInput(name_, "expected the connection of a message before it");
        const auto [topic, type] = found->second;
        return topics_.add({time(header), topic, type, Encoding::ros1, data});
      }
      case bag_header:
      case index_data:
      case chunk_info: return;
      default: throw BadInput(name_, "expected a record of ROS bags of version 2.0");
    }
  }

  const std::string& name_;
  std::map<std::uint32_t, Connection> connections_;
  TopicLog topics_;
};

}  // namespace

bool is_ros_bag(std::string_view bytes) { return bytes.starts_with("#ROSBAG"); }

SensorLog parse_ros_bag(const std::string& name, std::string_view bytes, const LogChoice& choice) {
  if (!bytes.starts_with(magic)) throw BadInput(name, "expected a ROS bag of version 2.0");
  BagParser parser(name);
  parser.parse(bytes.substr(magic.size()), false);
  return parser.topics().finish("ROS bag", choice);
}

}  // namespace waitpoint::logs
