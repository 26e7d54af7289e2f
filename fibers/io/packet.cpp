// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/io/packet.hpp"

#include <cstring>

#include "core/error.hpp"
#include "fibers/io/letter.hpp"

namespace waitpoint::io {
namespace {

/// What precedes the ports and the bytes.
struct Header {
  PacketKind kind{};
  std::uint64_t from = 0, to = 0, number = 0;
  std::uint32_t from_port_size = 0, to_port_size = 0;
  static void fields(auto field) {
    field("kind", &Header::kind);
    field("from", &Header::from);
    field("to", &Header::to);
    field("number", &Header::number);
    field("from_port_size", &Header::from_port_size);
    field("to_port_size", &Header::to_port_size);
  }
};

void append(std::vector<std::byte>& to, std::span<const std::byte> bytes) {
  to.insert(to.end(), bytes.begin(), bytes.end());
}

std::string take_text(std::span<const std::byte>& rest, std::size_t size) {
  const std::span<const std::byte> text = take(rest, size);
  return {reinterpret_cast<const char*>(text.data()), text.size()};
}

}  // namespace

std::vector<std::byte> to_bytes(const Packet& packet) {
  WAITPOINT_CHECK(packet.kind != PacketKind::parcel, "a parcel leaves its process");
  std::vector<std::byte> bytes = encoded(Header{packet.kind, packet.from.socket, packet.to.socket, packet.number,
                                                static_cast<std::uint32_t>(packet.from.port.size()),
                                                static_cast<std::uint32_t>(packet.to.port.size())});
  bytes.reserve(bytes.size() + packet.from.port.size() + packet.to.port.size() + packet.bytes.size());
  append(bytes, std::as_bytes(std::span(packet.from.port)));
  append(bytes, std::as_bytes(std::span(packet.to.port)));
  append(bytes, packet.bytes);
  return bytes;
}

Packet packet_of(std::span<const std::byte> bytes) {
  Header header;
  decode(header, bytes);
  WAITPOINT_CHECK(header.kind < PacketKind::parcel, "a packet from another process is of no known kind");
  Packet packet{header.kind, {.socket = header.from}, {.socket = header.to}, header.number, {}};
  packet.from.port = take_text(bytes, header.from_port_size);
  packet.to.port = take_text(bytes, header.to_port_size);
  packet.bytes.assign(bytes.begin(), bytes.end());
  return packet;
}

}  // namespace waitpoint::io
