// SPDX-License-Identifier: BSD-3-Clause
// Lines of text in both directions of a connection. The side of the run never blocks: a peer that does not read loses
// the excess over the buffers, and a flood of lines waits in the system's, which holds up its sender.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "modules/outside/descriptor.hpp"

namespace waitpoint::outside {

class LineStream {
 public:
  explicit LineStream(Descriptor connection) : connection_(std::move(connection)) {}

  /// Receives the data at hand, of a flood a part; a blocking connection waits until there is something.
  void receive();
  /// Removes the next complete line, without its end. A line that is too long ends the connection.
  bool take(std::string& line);
  /// Sends `lines`, or none of them: false if the peer does not read, or is gone.
  bool send(std::string_view lines);

  /// The peer sends no more, or the connection broke: take() has the last lines. The peer may still read.
  bool is_over() const { return is_over_; }
  /// Lines taken so far.
  int lines() const { return lines_; }

 private:
  bool flush();

  Descriptor connection_;
  std::string received_, sent_;
  std::size_t begin_ = 0;  // of the next line in received_
  int lines_ = 0;
  bool is_over_ = false;
};

}  // namespace waitpoint::outside
