// SPDX-License-Identifier: BSD-3-Clause
// A pipe between tasks of one robot: a bounded queue of bytes with a read end and a write end, with the semantics of
// POSIX pipes.
//
//   auto [reader, writer] = io::make_pipe();
//
// Ends are handles that may be copied, as by dup(): an end is closed when its last copy is closed or destroyed; a call
// in progress keeps its end open. Bytes are read in the order in which they were written.
#pragma once

#include <memory>
#include <span>

#include "fibers/io/byte_queue.hpp"
#include "fibers/io/channel.hpp"

namespace waitpoint::io {

/// A write of at most this many bytes, if the capacity allows, is atomic, not interleaved with others' (POSIX:
/// PIPE_BUF).
inline constexpr std::size_t atomic_max = 4096;
inline constexpr std::size_t buffer_default = 65536;
inline constexpr std::size_t buffer_max = 64 << 20;

/// Shared by the ends of a pipe.
class Pipe : public Channel {
 public:
  enum class Side : std::uint8_t { reading, writing };

  Pipe(std::size_t capacity, std::string label);
  Result<std::size_t> read(std::span<std::byte> buffer, const Deadline& deadline);
  Result<std::size_t> write(std::span<const std::byte> data, const Deadline& deadline);
  void close(Side side);
  Events ready() const override;

 private:
  void refresh() override { bytes_.clear(); }

  ByteQueue bytes_;
  bool reading_ = true;  // a read end is open
  bool writing_ = true;
};

/// A copyable handle to one end. Any use but assignment after its close() is a misuse.
class PipeHandle {
 public:
  bool is_open() const { return end_ != nullptr; }
  /// Releases this handle.
  void close() {
    use();
    end_ = nullptr;
  }
  std::shared_ptr<Channel> channel() const { return use()->pipe; }

 protected:
  PipeHandle() = default;
  PipeHandle(std::shared_ptr<Pipe> pipe, Pipe::Side side) : end_(std::make_shared<End>(std::move(pipe), side)) {}

  struct End {
    End(std::shared_ptr<Pipe> of, Pipe::Side which) : pipe(std::move(of)), side(which) {}
    End(const End&) = delete;
    End& operator=(const End&) = delete;
    ~End() { pipe->close(side); }
    std::shared_ptr<Pipe> pipe;
    Pipe::Side side;
  };
  // A reference of its own, which keeps the end open during a call.
  std::shared_ptr<End> use() const {
    WAITPOINT_REQUIRE(end_ != nullptr, "an end of a pipe is used after its close");
    return end_;
  }

 private:
  std::shared_ptr<End> end_;
};

class pipe_reader : public PipeHandle {
 public:
  pipe_reader() = default;  ///< closed
  explicit pipe_reader(std::shared_ptr<Pipe> pipe) : PipeHandle(std::move(pipe), Pipe::Side::reading) {}

  /// Reads at least one byte and at most buffer.size(), and returns the number. end_of_file once the pipe is empty and
  /// no write end is open.
  Result<std::size_t> read(std::span<std::byte> buffer, const Deadline& deadline = {}) {
    return use()->pipe->read(buffer, deadline);
  }
};

class pipe_writer : public PipeHandle {
 public:
  pipe_writer() = default;  ///< closed
  explicit pipe_writer(std::shared_ptr<Pipe> pipe) : PipeHandle(std::move(pipe), Pipe::Side::writing) {}

  /// Writes all of `data` and returns the number of bytes, which is less only if the status is not ok. peer_closed once
  /// no read end is open.
  Result<std::size_t> write(std::span<const std::byte> data, const Deadline& deadline = {}) {
    return use()->pipe->write(data, deadline);
  }
};

struct PipeEnds {
  pipe_reader reader;
  pipe_writer writer;
};

/// A pipe that holds `capacity` bytes (1 to buffer_max).
PipeEnds make_pipe(std::size_t capacity = buffer_default, std::string label = "");

}  // namespace waitpoint::io
