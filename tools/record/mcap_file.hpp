// SPDX-License-Identifier: BSD-3-Clause
// An MCAP file (mcap.dev, version 0): messages of several channels by time, with an index, so that viewers can seek.
// Uncompressed chunks of about a megabyte, each with a checksum.
//
//   magic | Header | (Chunk MessageIndex...)... | DataEnd | Schema... Channel... ChunkIndex... Statistics
//         | SummaryOffset... | Footer | magic
//
// Equal messages give equal bytes: the file does not depend on the machine or the clock.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/time.hpp"
#include "tools/output/output_file.hpp"

namespace waitpoint::tools {

class McapFile {
 public:
  /// Counts the topics, which are channels of the file, from 0.
  using Topic = std::uint16_t;

  /// Throws BadInput if the file cannot be written; so do write() and finish().
  explicit McapFile(const std::filesystem::path& path);

  /// Adds a topic with JSON messages of a JSON Schema. Schemas of one name have one text.
  Topic add(const std::string& schema_name, const std::string& schema, const std::string& topic);
  /// Appends a message that was received at `time`; times need not ascend.
  void write(Topic topic, Time time, std::string_view message);
  /// Writes the index and renames the file into place; called last.
  void finish();

 private:
  struct ChunkPlace {
    std::uint64_t first_ns, last_ns, offset, length, index_length, size;
    std::map<std::uint16_t, std::uint64_t> index_offsets;  // by channel
  };
  struct Group {
    std::uint8_t operation;
    std::uint64_t offset, length;
  };

  std::uint16_t number_of(const std::string& schema_name, const std::string& schema);
  void append(std::string_view bytes);
  void end_chunk();
  static std::string as_record(const ChunkPlace& place);
  std::string statistics_record() const;

  OutputFile file_;
  std::uint64_t size_ = 0;
  std::uint32_t checksum_ = 0;                    // of everything written
  std::vector<std::string> schemas_, channels_;   // as records
  std::map<std::string, std::uint16_t> numbers_;  // of schemas, by name
  std::string chunk_;
  std::uint64_t chunk_first_ns_ = 0, chunk_last_ns_ = 0;
  std::map<std::uint16_t, std::vector<std::pair<std::uint64_t, std::uint64_t>>> in_chunk_;  // (time, offset) by channel
  std::vector<ChunkPlace> chunks_;
  std::map<std::uint16_t, std::uint64_t> messages_;  // by channel
  std::uint64_t first_ns_ = ~std::uint64_t{0}, last_ns_ = 0;
};

}  // namespace waitpoint::tools
