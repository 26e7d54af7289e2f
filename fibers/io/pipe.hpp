// SPDX-License-Identifier: BSD-3-Clause
// A pipe between tasks of one robot: a bounded queue of bytes with an end to read and an end to write, to the semantics
// of POSIX pipes.
//
//   auto [reader, writer] = io::make_pipe();
//
// Ends are handles that may be copied, as by dup(): an end is closed when its last copy is closed or destroyed; a call
// under way keeps its end open. Bytes come out in the order in which they were written.
#pragma once

#include <memory>
#include <span>

#include "fibers/io/byte_queue.hpp"
#include "fibers/io/channel.hpp"

namespace waitpoint::io {

/// A write of so many bytes, if the capacity allows, is made as a whole and not mixed with others' (POSIX: PIPE_BUF).
inline constexpr std::size_t atomic_max = 4096;
inline constexpr std::size_t buffer_default = 65536;
inline constexpr std::size_t buffer_max = 64 << 20;

/// What the ends of a pipe share.
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
  bool reading_ = true;  // an end to read is open
  bool writing_ = true;
};

/// A copyable handle to one end. Any use but assignment after its close() is a bug.
class PipeHandle {
 public:
  bool is_open() const { return end_ != nullptr; }
  /// Gives this handle up.
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
  // A share of its own, which keeps the end open while a call is under way.
  std::shared_ptr<End> use() const {
    WAITPOINT_CHECK(end_ != nullptr, "an end of a pipe is used after its close");
    return end_;
  }

 private:
  std::shared_ptr<End> end_;
};

class pipe_reader : public PipeHandle {
 public:
  pipe_reader() = default;  ///< closed
  explicit pipe_reader(std::shared_ptr<Pipe> pipe) : PipeHandle(std::move(pipe), Pipe::Side::reading) {}

  /// Takes at least one byte and at most buffer.size(): how many. end_of_file once the pipe is empty and no end to
  /// write is open.
  Result<std::size_t> read(std::span<std::byte> buffer, const Deadline& deadline = {}) {
    return use()->pipe->read(buffer, deadline);
  }
};

class pipe_writer : public PipeHandle {
 public:
  pipe_writer() = default;  ///< closed
  explicit pipe_writer(std::shared_ptr<Pipe> pipe) : PipeHandle(std::move(pipe), Pipe::Side::writing) {}

  /// Puts all of `data` in: how many bytes, which is less than all of them only if the status is not ok. peer_closed
  /// once no end to read is open.
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
