// SPDX-License-Identifier: BSD-3-Clause
// A bounded queue of values between tasks. Tasks of its own robot use it directly; others, or those that know only its
// name, through a mailbox_sender.
//
//   io::mailbox<Order> orders(8);              // ada
//   orders.bind(network, "orders");
//   auto order = orders.receive(50ms);
//
//   io::mailbox_sender<Order> to_ada(network, "ada:orders");    // bob
//   to_ada.send(order);
//
// A full mailbox blocks its own robot's senders. Letters from a mailbox_sender are limited by the sender's window
// instead, which counts letters in transit and not yet received. Letters are never lost: the medium delays them.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <utility>

#include "fibers/io/letter.hpp"
#include "fibers/io/letter_box.hpp"
#include "fibers/sync/ignored_accesses.hpp"

namespace waitpoint::io {

/// The greatest capacity of a mailbox, and the greatest window of a sender.
inline constexpr std::size_t letters_max = 65536;

template <class T>
class mailbox : public LetterBox {
 public:
  /// Holds `capacity` letters, from one to letters_max.
  explicit mailbox(std::size_t capacity, std::string label = "")
      : LetterBox("mailbox", std::move(label)), capacity_(capacity) {
    WAITPOINT_REQUIRE(capacity > 0 && capacity <= letters_max, "a mailbox holds at least one letter and at most 65536");
  }
  /// Destroying a mailbox at which a task waits is a misuse.
  ~mailbox() override {
    const bool tell = begin_release(kernel::Operation::close, receiving_);
    WAITPOINT_REQUIRE(!tell || !is_waited_for(), "a mailbox is destroyed while a task waits at it");
    shut(tell);
  }

  /// Binds a name on this robot: ok or address_in_use. A second name is a misuse.
  Status bind(Network& network, const std::string& port);

  /// Enqueues a letter, moved from only if the status is ok; peer_closed once the mailbox is closed.
  template <class Letter = T>
  Status send(Letter&& letter, const Deadline& deadline = {});
  template <class Letter = T>
  Status try_send(Letter&& letter) {
    return send(std::forward<Letter>(letter), no_wait);
  }
  template <class Letter = T, class Span>
  Status send_for(Letter&& letter, const Span& span) {
    return send(std::forward<Letter>(letter), Deadline(span));
  }

  /// Dequeues the oldest letter; end_of_file once the mailbox is closed and empty.
  Result<T> receive(const Deadline& deadline = {});
  Result<T> try_receive() { return receive(no_wait); }
  template <class Span>
  Result<T> receive_for(const Span& span) {
    return receive(Deadline(span));
  }

  /// Accepts no more letters and releases its name; queued letters can still be received. Closing again does nothing.
  void close() {
    if (begin_release(kernel::Operation::close, receiving_)) shut(true);
  }

  std::size_t capacity() const { return capacity_; }
  Events ready() const override {
    const sync::IgnoredAccesses ignored_accesses;
    return when(!letters_.empty() || closed_, Events::readable) |
           when(letters_.size() < capacity_ || closed_, Events::writable) | when(closed_, Events::closed);
  }

  void arrive(std::uint64_t type, std::span<const std::byte> letter, const Receipt& receipt) override;

 private:
  struct Entry {
    T letter;
    Receipt receipt = {};
  };
  void refresh() override {
    const sync::IgnoredAccesses ignored_accesses;
    letters_.clear();
    closed_ = false;
    node_ = nullptr;
  }
  void shut(bool tell);

  std::size_t capacity_;
  std::deque<Entry> letters_;
  bool closed_ = false;
  std::shared_ptr<Node> node_;  // where its name is bound, or was before it was closed
  std::string port_;
  std::uint64_t type_ = 0;  // letter_type() of a mailbox with a name
};

template <class T>
Status mailbox<T>::bind(Network& network, const std::string& port) {
  if (!begin(kernel::Operation::open, receiving_)) return Status::closed;
  WAITPOINT_REQUIRE(node_ == nullptr, "a mailbox is bound a second time");
  WAITPOINT_REQUIRE(!closed_, "a mailbox is bound after its close");
  std::shared_ptr<Node> node = network.own_node();
  if (!node->bind(Protocol::mailbox, port, *this)) return Status::address_in_use;
  node_ = std::move(node);
  port_ = port;
  if constexpr (Sendable<T>) type_ = letter_type<T>();
  set_label(node_->name() + ":" + port);
  return Status::ok;
}

template <class T>
void mailbox<T>::arrive(std::uint64_t type, std::span<const std::byte> letter, const Receipt& receipt) {
  const sync::IgnoredAccesses ignored_accesses;
  WAITPOINT_REQUIRE(Sendable<T> && type == type_, "a letter is sent to a mailbox of another type");
  if constexpr (Sendable<T>) {
    Entry& entry = letters_.emplace_back(Entry{T(), receipt});
    decode(entry.letter, letter);
    wake_one_for_arrival(receiving_);
  }
}

template <class T>
template <class Letter>
Status mailbox<T>::send(Letter&& letter, const Deadline& deadline) {
  if (!begin(kernel::Operation::send, sending_)) return Status::closed;
  const Status status = wait(sending_, deadline, [&] {
    const sync::IgnoredAccesses ignored_accesses;
    return closed_ || letters_.size() < capacity_;
  });
  if (status != Status::ok) return status;
  const sync::IgnoredAccesses ignored_accesses;
  if (closed_) return Status::peer_closed;
  letters_.push_back({T(std::forward<Letter>(letter))});
  if constexpr (Sendable<T>) record_sent("mailbox", hash_of(letters_.back().letter));
  wake_one(receiving_);
  return Status::ok;
}

template <class T>
Result<T> mailbox<T>::receive(const Deadline& deadline) {
  if (!begin(kernel::Operation::receive, receiving_)) return Status::closed;
  const Status status = wait(receiving_, deadline, [&] {
    const sync::IgnoredAccesses ignored_accesses;
    return closed_ || !letters_.empty();
  });
  if (status != Status::ok) return status;
  const sync::IgnoredAccesses ignored_accesses;
  if (letters_.empty()) return Status::end_of_file;
  Entry entry = std::move(letters_.front());
  letters_.pop_front();
  entry.receipt.send(Status::ok);
  // Letters of mailbox_senders may exceed the capacity: then there is no room yet.
  if (letters_.size() < capacity_) wake_one(sending_);
  return std::move(entry.letter);
}

template <class T>
void mailbox<T>::shut(bool tell) {
  const sync::IgnoredAccesses ignored_accesses;
  const bool was_closed = std::exchange(closed_, true);
  if (node_ != nullptr && !was_closed) node_->release(Protocol::mailbox, port_);
  if (was_closed || !tell) return;
  for (const Entry& entry : letters_) entry.receipt.send(Status::peer_closed);
  wake_all(receiving_);
  wake_all(sending_);
}

}  // namespace waitpoint::io
