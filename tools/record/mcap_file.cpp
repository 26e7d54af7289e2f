// SPDX-License-Identifier: BSD-3-Clause
#include "tools/record/mcap_file.hpp"

#include <zlib.h>

#include <algorithm>

namespace waitpoint::tools {
namespace {

constexpr std::string_view magic{"\x89MCAP0\r\n", 8};
constexpr std::size_t chunk_size = 1 << 20;

enum Operation : std::uint8_t {
  header = 1,
  footer = 2,
  schema = 3,
  channel = 4,
  message = 5,
  chunk = 6,
  message_index = 7,
  chunk_index = 8,
  statistics = 0x0B,
  summary_offset = 0x0E,
  data_end = 0x0F,
};

/// The fields of a record: little-endian numbers, texts with a length prefix.
class Fields {
 public:
  template <class Number>
  Fields& number(Number value) {
    for (std::size_t i = 0; i < sizeof value; ++i) bytes_ += static_cast<char>(value >> (8 * i));
    return *this;
  }
  Fields& raw(std::string_view bytes) {
    bytes_ += bytes;
    return *this;
  }
  Fields& text(std::string_view bytes) { return number(static_cast<std::uint32_t>(bytes.size())).raw(bytes); }
  /// A map: its entries after their size in bytes.
  Fields& map(const Fields& entries) { return text(entries.bytes_); }

  std::string as_record(Operation operation) const {
    Fields record;
    record.number(static_cast<std::uint8_t>(operation)).number(std::uint64_t{bytes_.size()}).raw(bytes_);
    return record.bytes_;
  }

 private:
  std::string bytes_;
};

std::uint32_t crc(std::uint32_t so_far, std::string_view bytes) {
  return static_cast<std::uint32_t>(
      crc32(so_far, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size())));
}

std::uint64_t ns(Time time) { return static_cast<std::uint64_t>(time.ns()); }

}  // namespace

McapFile::McapFile(const std::filesystem::path& path) : file_(path) {
  append(magic);
  append(Fields().text("").text("waitpoint").as_record(header));
}

void McapFile::append(std::string_view bytes) {
  file_.write(bytes);
  checksum_ = crc(checksum_, bytes);
  size_ += bytes.size();
}

std::uint16_t McapFile::number_of(const std::string& name, const std::string& text) {
  const auto [found, is_new] = numbers_.try_emplace(name, schemas_.size() + 1);  // 0 is none
  if (!is_new) return found->second;
  schemas_.push_back(Fields().number(found->second).text(name).text("jsonschema").text(text).as_record(schema));
  chunk_ += schemas_.back();
  return found->second;
}

McapFile::Topic McapFile::add(const std::string& schema_name, const std::string& schema_text,
                              const std::string& topic) {
  const std::uint16_t number = number_of(schema_name, schema_text);
  const auto id = static_cast<Topic>(channels_.size());
  channels_.push_back(Fields().number(id).number(number).text(topic).text("json").map(Fields()).as_record(channel));
  chunk_ += channels_.back();
  messages_[id] = 0;
  return id;
}

void McapFile::write(Topic on, Time time, std::string_view text) {
  const std::uint64_t at = ns(time);
  std::vector<std::pair<std::uint64_t, std::uint64_t>>& index = in_chunk_[on];
  const bool is_first = in_chunk_.size() == 1 && index.empty();
  chunk_first_ns_ = is_first ? at : std::min(chunk_first_ns_, at);
  chunk_last_ns_ = is_first ? at : std::max(chunk_last_ns_, at);
  first_ns_ = std::min(first_ns_, at);
  last_ns_ = std::max(last_ns_, at);
  index.emplace_back(at, chunk_.size());
  const auto sequence = static_cast<std::uint32_t>(messages_[on]++);
  chunk_ += Fields().number(on).number(sequence).number(at).number(at).raw(text).as_record(message);
  if (chunk_.size() >= chunk_size) end_chunk();
}

void McapFile::end_chunk() {
  if (chunk_.empty()) return;
  ChunkPlace place{chunk_first_ns_, chunk_last_ns_, size_, 0, 0, chunk_.size(), {}};
  append(Fields()
             .number(chunk_first_ns_)
             .number(chunk_last_ns_)
             .number(std::uint64_t{chunk_.size()})
             .number(crc(0, chunk_))
             .text("")  // no compression
             .number(std::uint64_t{chunk_.size()})
             .raw(chunk_)
             .as_record(chunk));
  place.length = size_ - place.offset;
  for (const auto& [on, messages] : in_chunk_) {
    place.index_offsets[on] = size_;
    Fields entries;
    for (const auto& [time, offset] : messages) entries.number(time).number(offset);
    append(Fields().number(on).map(entries).as_record(message_index));
  }
  place.index_length = size_ - place.offset - place.length;
  chunks_.push_back(std::move(place));
  chunk_.clear();
  in_chunk_.clear();
  chunk_first_ns_ = chunk_last_ns_ = 0;
}

std::string McapFile::as_record(const ChunkPlace& place) {
  Fields offsets;
  for (const auto& [on, offset] : place.index_offsets) offsets.number(on).number(offset);
  return Fields()
      .number(place.first_ns)
      .number(place.last_ns)
      .number(place.offset)
      .number(place.length)
      .map(offsets)
      .number(place.index_length)
      .text("")  // no compression
      .number(place.size)
      .number(place.size)
      .as_record(chunk_index);
}

std::string McapFile::statistics_record() const {
  Fields counts;
  std::uint64_t sum = 0;
  for (const auto& [on, count] : messages_) {
    counts.number(on).number(count);
    sum += count;
  }
  return Fields()
      .number(sum)
      .number(static_cast<std::uint16_t>(schemas_.size()))
      .number(static_cast<std::uint32_t>(channels_.size()))
      .number(std::uint32_t{0})  // attachments
      .number(std::uint32_t{0})  // metadata
      .number(static_cast<std::uint32_t>(chunks_.size()))
      .number(sum == 0 ? 0 : first_ns_)
      .number(last_ns_)
      .map(counts)
      .as_record(statistics);
}

void McapFile::finish() {
  end_chunk();
  append(Fields().number(checksum_).as_record(data_end));
  const std::uint64_t summary_start = size_;
  std::string summary;
  std::vector<Group> groups;
  const auto add_group = [&](Operation operation, const std::vector<std::string>& records) {
    if (records.empty()) return;
    groups.push_back({operation, summary_start + summary.size(), 0});
    for (const std::string& record : records) summary += record;
    groups.back().length = summary_start + summary.size() - groups.back().offset;
  };
  add_group(schema, schemas_);
  add_group(channel, channels_);
  std::vector<std::string> places;
  for (const ChunkPlace& place : chunks_) places.push_back(as_record(place));
  add_group(chunk_index, places);
  add_group(statistics, {statistics_record()});
  const std::uint64_t offsets_start = summary_start + summary.size();
  for (const Group& group : groups)
    summary += Fields().number(group.operation).number(group.offset).number(group.length).as_record(summary_offset);
  // The footer's checksum covers the summary and the footer up to the checksum itself.
  constexpr std::size_t checksum_bytes = 4;
  const std::string last =
      Fields().number(summary_start).number(offsets_start).number(std::uint32_t{0}).as_record(footer);
  const std::uint32_t of_summary = crc(crc(0, summary), std::string_view(last).substr(0, last.size() - checksum_bytes));
  append(summary);
  append(Fields().number(summary_start).number(offsets_start).number(of_summary).as_record(footer));
  append(magic);
  file_.commit();
}

}  // namespace waitpoint::tools
