// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/io/pipe.hpp"

namespace waitpoint::io {

Pipe::Pipe(std::size_t capacity, std::string label) : Channel("pipe", std::move(label)), bytes_(capacity) {
  WAITPOINT_REQUIRE(capacity > 0 && capacity <= buffer_max, "a pipe holds at least one byte and at most 64 MiB");
}

Result<std::size_t> Pipe::read(std::span<std::byte> buffer, const Deadline& deadline) {
  if (!begin(kernel::Operation::receive, receiving_)) return Status::closed;
  if (buffer.empty()) return 0;
  const Status status = wait(receiving_, deadline, [&] { return !bytes_.empty() || !writing_; });
  if (status != Status::ok) return status;
  const std::size_t count = bytes_.pop(buffer);
  if (count == 0) return Status::end_of_file;
  // All, because a large write may have to keep waiting where a small one fits.
  wake_all(sending_);
  return count;
}

Result<std::size_t> Pipe::write(std::span<const std::byte> data, const Deadline& deadline) {
  if (!begin(kernel::Operation::send, sending_)) return Status::closed;
  const bool whole = data.size() <= std::min(atomic_max, bytes_.capacity());
  Digest sent;
  std::size_t written = 0;
  Status status = Status::ok;
  while (written < data.size()) {
    const std::size_t least = whole ? data.size() : 1;
    status = wait(sending_, deadline, [&] { return !reading_ || bytes_.room() >= least; });
    if (status == Status::ok && !reading_) status = Status::peer_closed;
    if (status != Status::ok) break;
    const auto part = data.subspan(written, std::min(data.size() - written, bytes_.room()));
    bytes_.push(part);
    written += part.size();
    sent.add(std::string_view(reinterpret_cast<const char*>(part.data()), part.size()));
    wake_all(receiving_);
  }
  if (written > 0) record_sent("pipe", sent.value());
  return {status, written};
}

void Pipe::close(Side side) {
  bool& open = side == Side::reading ? reading_ : writing_;
  kernel::Object& own = side == Side::reading ? receiving_ : sending_;
  const bool tell = begin_release(kernel::Operation::close, own);
  open = false;
  if (!tell) return;
  wake_all(receiving_);
  wake_all(sending_);
}

Events Pipe::ready() const {
  return when(!bytes_.empty() || !writing_, Events::readable) | when(bytes_.room() > 0 || !reading_, Events::writable) |
         when(!reading_ || !writing_, Events::closed);
}

PipeEnds make_pipe(std::size_t capacity, std::string label) {
  const auto pipe = std::make_shared<Pipe>(capacity, std::move(label));
  return {pipe_reader(pipe), pipe_writer(pipe)};
}

}  // namespace waitpoint::io
