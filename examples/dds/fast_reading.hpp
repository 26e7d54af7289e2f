// SPDX-License-Identifier: BSD-3-Clause
// The type of reading.idl for Fast DDS, by hand.
#pragma once

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>
#include <fastdds/dds/topic/TopicDataType.hpp>

#include <cstdint>
#include <functional>

namespace example {

struct Reading {
  std::uint32_t number = 0;
  double range_m = 0;
};

using eprosima::fastcdr::Cdr;
using Payload = eprosima::fastrtps::rtps::SerializedPayload_t;

class ReadingType : public eprosima::fastdds::dds::TopicDataType {
 public:
  ReadingType() {
    setName("example::Reading");
    m_typeSize = head_bytes + data_bytes;
    m_isGetKeyDefined = false;
  }

  bool serialize(void* data, Payload* payload) override {
    eprosima::fastcdr::FastBuffer bytes(reinterpret_cast<char*>(payload->data), payload->max_size);
    Cdr text(bytes, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR);
    payload->encapsulation = text.endianness() == Cdr::BIG_ENDIANNESS ? CDR_BE : CDR_LE;
    text.serialize_encapsulation();
    const auto& reading = *static_cast<const Reading*>(data);
    text << reading.number << reading.range_m;
    payload->length = static_cast<std::uint32_t>(text.getSerializedDataLength());
    return true;
  }
  bool deserialize(Payload* payload, void* data) override {
    eprosima::fastcdr::FastBuffer bytes(reinterpret_cast<char*>(payload->data), payload->length);
    Cdr text(bytes, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR);
    text.read_encapsulation();
    auto& reading = *static_cast<Reading*>(data);
    text >> reading.number >> reading.range_m;
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void*) override {
    return [] { return head_bytes + data_bytes; };
  }
  void* createData() override { return new Reading; }
  void deleteData(void* data) override { delete static_cast<Reading*>(data); }
  bool getKey(void*, eprosima::fastrtps::rtps::InstanceHandle_t*, bool) override { return false; }

 private:
  static constexpr std::uint32_t head_bytes = 4, data_bytes = 16;  // the number is padded to eight bytes
};

}  // namespace example
