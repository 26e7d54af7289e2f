// SPDX-License-Identifier: BSD-3-Clause
// A poster: a value that one writer shows to many readers.
//
// The date is set when a write is given, and is the writer's local virtual time then: a value that took c to compute
// from s on is dated, and seen by others, at s + c. A read before the first write finds the poster empty.
#pragma once

#include <algorithm>
#include <mutex>
#include <optional>
#include <string>
#include <typeinfo>

#include "fibers/sync/threads.hpp"

namespace waitpoint::genom {

/// What posters of all types have in common.
class PosterBase {
 public:
  virtual ~PosterBase() = default;
  PosterBase(const PosterBase&) = delete;
  PosterBase& operator=(const PosterBase&) = delete;

  const std::string& name() const { return name_; }
  /// The module (or the bridge) that alone may write.
  const std::string& writer() const { return writer_; }
  virtual const std::type_info& type() const = 0;

  /// How long a module's access to it takes, as one to hardware: the local time of the task that reads or writes it
  /// moves on by so much. What it reads is so old then, what it writes comes so late.
  Duration latency() const { return latency_; }
  void set_latency(Duration latency) { latency_ = latency; }

  /// What of it every access touches; of a large value only the beginning.
  virtual void add_to(WorkingSet& set) const = 0;

 protected:
  PosterBase(std::string name, std::string writer);

  std::string name_;
  std::string writer_;
  // What every access touches: from the beginning of a cache line on.
  alignas(64) mutable threads::mutex mutex_{"poster"};
  std::uint64_t name_hash_;
  std::uint64_t writes_ = 0;
  Time date_;
  Duration latency_;
};

enum class PosterStatus : std::uint8_t { ok, empty };

template <HasFields T>
class Poster : public PosterBase {
 public:
  Poster(std::string name, std::string writer) : PosterBase(std::move(name), std::move(writer)) {}
  const std::type_info& type() const override { return typeid(T); }
  void add_to(WorkingSet& set) const override;

  /// Gives a new value; for the poster's writer only.
  void write(const T& value) {
    const std::lock_guard guard(mutex_);
    value_ = value;
    ++writes_;
    date_ = threads::now();
    threads::record(name_hash_, value);
  }

  /// Copies the value out; `date`, if given, gets the date of its write.
  PosterStatus read(T& value, Time* date = nullptr) const {
    const std::lock_guard guard(mutex_);
    if (writes_ == 0) return PosterStatus::empty;
    value = value_;
    if (date != nullptr) *date = date_;
    return PosterStatus::ok;
  }

  /// The value for an observer who is no part of the robot's software, nothing if there is none yet: in simulation no
  /// event.
  std::optional<T> look() const {
    const threads::observer_lock guard(mutex_);
    return writes_ > 0 ? std::optional(value_) : std::nullopt;
  }

 private:
  T value_{};
};

template <HasFields T>
void Poster<T>::add_to(WorkingSet& set) const {
  constexpr std::size_t of_value_max = 192;
  set.add_between(&mutex_, reinterpret_cast<const char*>(&value_) + std::min(sizeof value_, of_value_max));
}

/// A module's wish to read a poster of another, found by its name when the robot is put together.
class PosterLinkBase {
 public:
  virtual ~PosterLinkBase() = default;
  const std::string& name() const { return name_; }
  virtual const std::type_info& type() const = 0;
  /// Connects; false if `poster` is of another type.
  virtual bool connect(PosterBase& poster) = 0;
  /// What of it and of the poster every reading touches.
  virtual void add_to(WorkingSet& set) const = 0;

 protected:
  explicit PosterLinkBase(std::string name) : name_(std::move(name)) {}
  std::string name_;
};

template <HasFields T>
class PosterLink : public PosterLinkBase {
 public:
  explicit PosterLink(std::string name) : PosterLinkBase(std::move(name)) {}
  const std::type_info& type() const override { return typeid(T); }
  bool connect(PosterBase& poster) override {
    poster_ = dynamic_cast<Poster<T>*>(&poster);
    return poster_ != nullptr;
  }
  bool connected() const { return poster_ != nullptr; }
  void add_to(WorkingSet& set) const override {
    set.add(*this);
    if (poster_ != nullptr) poster_->add_to(set);
  }

  /// As Poster::read; a link that may be absent and is not connected reads as empty.
  PosterStatus read(T& value, Time* date = nullptr) const {
    if (poster_ == nullptr) return PosterStatus::empty;
    const PosterStatus status = poster_->read(value, date);
    threads::access_hardware(poster_->latency());
    return status;
  }

 private:
  const Poster<T>* poster_ = nullptr;
};

}  // namespace waitpoint::genom
