// SPDX-License-Identifier: BSD-3-Clause
#include "modules/logs/mcap_log.hpp"

#include <map>
#include <optional>

#include "modules/logs/decompression.hpp"
#include "modules/logs/topic_log.hpp"
#include "modules/messages/byte_reader.hpp"

namespace waitpoint::logs {
namespace {

constexpr std::string_view magic("\x89MCAP0\r\n", 8);

enum : std::uint8_t { footer = 2, schema = 3, channel = 4, message = 5, chunk = 6, data_end = 15 };

struct Channel {
  std::string topic, type;
  std::optional<Encoding> encoding;
};

std::optional<Encoding> encoding_of(std::string_view name) {
  if (name == "ros1") return Encoding::ros1;
  if (name == "cdr") return Encoding::cdr;
  if (name == "json") return Encoding::json;
  return std::nullopt;
}

class McapParser {
 public:
  explicit McapParser(const std::string& name) : name_(name), topics_(name) {}

  /// Up to the end of the data, before the summary.
  void parse(std::string_view bytes, bool is_in_chunk) {
    for (ByteReader reader(name_, bytes); !reader.at_end();) {
      const auto operation = reader.number<std::uint8_t>();
      const std::string_view record = reader.take(reader.number<std::uint64_t>());
      if (operation == data_end || operation == footer) return;
      take(operation, ByteReader(name_, record), is_in_chunk);
    }
    if (!is_in_chunk) throw BadInput(name_, "expected the end of the data, found the end of the file");
  }
  TopicLog& topics() { return topics_; }

 private:
  void take(std::uint8_t operation, ByteReader record, bool is_in_chunk) {
    switch (operation) {
      case schema: {
        const auto number = record.number<std::uint16_t>();
        schemas_[number] = record.text();
        return;
      }
      case channel: {
        const auto number = record.number<std::uint16_t>(), of_schema = record.number<std::uint16_t>();
        Channel& added = channels_[number];
        added.topic = record.text();
        added.type = schemas_[of_schema];
        added.encoding = encoding_of(record.text());
        return;
      }
      case message: return take_message(record);
      case chunk: {
        if (is_in_chunk) record.reject("no chunk in a chunk");
        record.take(2 * sizeof(std::uint64_t) + sizeof(std::uint64_t) +
                    sizeof(std::uint32_t));  // times, size, checksum
        const std::string_view method = record.text();
        const std::string_view data = record.take(record.number<std::uint64_t>());
        if (method.empty()) return parse(data, true);
        return parse(decompressed(name_, method, data), true);
      }
      default: return;
    }
  }
  void take_message(ByteReader& record) {
    const auto found = channels_.find(record.number<std::uint16_t>());
    if (found == channels_.end()) record.reject("the channel of a message before it");
    record.take(sizeof(std::uint32_t));  // its number
    const auto received_ns = record.number<std::uint64_t>();
    if (received_ns > std::uint64_t{INT64_MAX}) record.reject("the time of a message before the year 2262");
    record.take(sizeof(std::uint64_t));  // when it was published
    const Channel& of = found->second;
    if (of.encoding)
      topics_.add({Time::from_ns(static_cast<std::int64_t>(received_ns)), of.topic, of.type, *of.encoding,
                   record.take(record.left())});
  }

  const std::string& name_;
  std::map<std::uint16_t, std::string> schemas_;
  std::map<std::uint16_t, Channel> channels_;
  TopicLog topics_;
};

}  // namespace

bool is_mcap(std::string_view bytes) { return bytes.starts_with(magic.substr(0, 5)); }

SensorLog parse_mcap(const std::string& name, std::string_view bytes, const LogChoice& choice) {
  if (!bytes.starts_with(magic)) throw BadInput(name, "expected MCAP of version 0");
  McapParser parser(name);
  parser.parse(bytes.substr(magic.size()), false);
  return parser.topics().finish("MCAP", choice);
}

}  // namespace waitpoint::logs
