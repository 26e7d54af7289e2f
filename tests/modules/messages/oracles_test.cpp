// SPDX-License-Identifier: BSD-3-Clause
// Every message that ROS has, compared with ROS's own generated code, and in CDR with Cyclone DDS: the same bytes of
// random values, the same MD5 sum, the same definition but for its comments.
#include <dds/ddsi/ddsi_cdrstream.h>
#include <oracle.h>
#include <ros/serialization.h>

#include <algorithm>
#include <map>
#include <sstream>

#include <oracle.hpp>
#include "modules/messages/description.hpp"
#include "modules/messages/wire.hpp"
#include "tests/modules/messages/random_message.hpp"

namespace waitpoint::messages {
namespace {

constexpr int values = 3000;

template <class Case>
class Messages : public ::testing::Test {};
struct Names {
  template <class Case>
  static std::string GetName(int) {
    std::string name(Case::Ours::type_name);
    std::replace(name.begin(), name.end(), '/', '_');
    return name;
  }
};
TYPED_TEST_SUITE(Messages, oracle::Cases, Names);

template <class RosMessage>
std::string bytes_by_ros(const RosMessage& message) {
  std::string bytes(ros::serialization::serializationLength(message), '\0');
  ros::serialization::OStream stream(reinterpret_cast<std::uint8_t*>(bytes.data()),
                                     static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(stream, message);
  return bytes;
}

template <class Case>
std::string bytes_by_cyclone(const typename Case::C& message) {
  dds_ostreamLE_t stream;
  dds_ostreamLE_init(&stream, 0, CDR_ENC_VERSION_1);
  dds_stream_writeLE(&stream, reinterpret_cast<const char*>(&message), Case::type->m_ops);
  const std::string bytes(reinterpret_cast<const char*>(stream.x.m_buffer), stream.x.m_index);
  dds_ostreamLE_fini(&stream);
  return std::string(cdr_head) + bytes;
}

/// The lines of a definition by type; constants after the fields, without comments and packages of types.
std::map<std::string, std::vector<std::string>> lines_of(const std::string& definition) {
  std::map<std::string, std::vector<std::string>> fields, constants;
  std::string type;
  std::istringstream lines(definition);
  for (std::string line; std::getline(lines, line);) {
    const auto is_space = [](char each) { return each == ' ' || each == '\t' || each == '\r'; };
    line.resize(std::min(line.size(), line.find('#')));
    std::istringstream words(line);
    std::string first, rest;
    if (!(words >> first) || first.starts_with("==")) continue;
    std::getline(words, rest);
    std::erase_if(rest, is_space);
    if (first == "MSG:")
      type = rest;
    else
      (rest.find('=') == rest.npos ? fields : constants)[type].push_back(first.substr(first.find('/') + 1) + " " +
                                                                         rest);
  }
  for (const auto& [name, all] : constants) fields[name].insert(fields[name].end(), all.begin(), all.end());
  return fields;
}

TYPED_TEST(Messages, HasTheBytesThatRosWrites) {
  using Ours = typename TypeParam::Ours;
  RandomMessages random(1);
  for (int i = 0; i < values; ++i) {
    const Ours message = random.make<Ours>();
    oracle::Memory memory;
    typename TypeParam::Ros copy;
    oracle::copy(memory, message, copy);
    ASSERT_EQ(encode<Wire::ros1>(message), bytes_by_ros(copy)) << i;
  }
}

TYPED_TEST(Messages, HasTheBytesThatCycloneDdsWrites) {
  using Ours = typename TypeParam::Ours;
  RandomMessages random(2);
  for (int i = 0; i < values; ++i) {
    const Ours message = random.make<Ours>();
    oracle::Memory memory;
    typename TypeParam::C copy{};
    oracle::copy(memory, message, copy);
    ASSERT_EQ(encode<Wire::cdr>(message), bytes_by_cyclone<TypeParam>(copy)) << i;
  }
}

TYPED_TEST(Messages, HasRossMd5SumAndDefinition) {
  using Traits = typename TypeParam::Ros;
  const Ros1Type& type = ros1_type<typename TypeParam::Ours>();
  EXPECT_EQ(type.name, ros::message_traits::DataType<Traits>::value());
  EXPECT_EQ(type.md5, ros::message_traits::MD5Sum<Traits>::value());
  EXPECT_EQ(lines_of(type.definition), lines_of(ros::message_traits::Definition<Traits>::value()));
}

template <class Message, Wire wire>
void check_decoding() {
  RandomMessages random(3);
  for (int i = 0; i < values; ++i) {
    const std::string bytes = encode<wire>(random.make<Message>());
    ASSERT_EQ((encode<wire>(decode<Message, wire>("m", bytes))), bytes) << i;
    const std::size_t cut = i % 2 == 0 ? bytes.size() - 1 : static_cast<std::size_t>(i) % bytes.size();
    ASSERT_THROW((decode<Message, wire>("m", std::string_view(bytes).substr(0, cut))), BadInput) << i;
  }
}

TYPED_TEST(Messages, IsReadBackAndRefusedIfCutOff) {
  check_decoding<typename TypeParam::Ours, Wire::ros1>();
  check_decoding<typename TypeParam::Ours, Wire::cdr>();
}

}  // namespace
}  // namespace waitpoint::messages
