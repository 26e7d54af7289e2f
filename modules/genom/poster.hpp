// SPDX-License-Identifier: BSD-3-Clause
// A poster: a named value with one writer and many readers, through which modules and bridge publish data.
//
// A write is dated with the writer's local virtual time: a value whose computation starts at s and costs c is dated,
// and seen by others, at s + c. Before the first write a poster reads as empty.
#pragma once

#include <algorithm>
#include <cstring>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <typeinfo>

#include "core/field_path.hpp"
#include "core/field_text.hpp"
#include "fibers/sync/threads.hpp"

namespace waitpoint::genom {

enum class PosterStatus : std::uint8_t { ok, empty };

/// The part of a poster that does not depend on its type.
class PosterBase {
 public:
  virtual ~PosterBase() = default;
  PosterBase(const PosterBase&) = delete;
  PosterBase& operator=(const PosterBase&) = delete;

  const std::string& name() const { return name_; }
  /// The only writer: a module or the bridge.
  const std::string& writer() const { return writer_; }
  virtual const std::type_info& type() const = 0;

  /// True if values have a number at this path: core/field_path.hpp.
  virtual bool has_number(std::string_view path) const = 0;
  /// Reads the numbers at the paths of all `readings` from one value, and its date.
  virtual PosterStatus read_numbers(std::span<FieldReading> readings, Time& date) const = 0;
  /// Copies the first `size` bytes of the value as C has it to `to`, as pocolibs' posterRead() does. False if the
  /// poster is empty, or its value has no type of C.
  virtual bool read_c(void* to, std::size_t size) const = 0;

  /// Duration of a module's access to it, as to hardware: added to the local time of the task that reads or writes. A
  /// value read is older, and a value written is published later, by it.
  Duration latency() const { return latency_; }
  void set_latency(Duration latency) { latency_ = latency; }

  /// For the writer, a device that keeps its next value until this one is taken: true if it has been read, other than
  /// as text or by numbers, since its last write. No event in simulation.
  bool was_read() const {
    const threads::observer_lock guard(mutex_);
    return was_read_;
  }

  /// True once a module's link leads to it.
  bool has_reader() const { return has_reader_; }
  void add_reader() { has_reader_ = true; }

  /// Adds the memory that every access touches; for a large value only its beginning.
  virtual void add_to(WorkingSet& set) const = 0;

  /// Reads the value as text by its declared fields (core/field_text.hpp), with the cost of a module's access; nothing
  /// if empty.
  virtual std::optional<std::string> read_text() const = 0;
  /// The structure of that text.
  virtual FieldShape shape() const = 0;

  // For observers outside the robot's software: no events in simulation.

  /// The value as read_text() has it; nothing if empty.
  virtual std::optional<std::string> look_text() const = 0;
  /// As read_numbers().
  virtual PosterStatus look_numbers(std::span<FieldReading> readings, Time& date) const = 0;
  /// The date of the last write; nothing before the first.
  std::optional<Time> look_date() const {
    const threads::observer_lock guard(mutex_);
    return writes_ > 0 ? std::optional(date_) : std::nullopt;
  }

 protected:
  PosterBase(std::string name, std::string writer);

  std::string name_;
  std::string writer_;
  // Touched by every access; starts a cache line.
  alignas(64) mutable threads::mutex mutex_{"poster"};
  std::uint64_t name_hash_;
  std::uint64_t writes_ = 0;
  Time date_;
  Duration latency_;
  mutable bool was_read_ = false;
  bool has_reader_ = false;
};

template <HasFields T>
class Poster : public PosterBase {
 public:
  Poster(std::string name, std::string writer) : PosterBase(std::move(name), std::move(writer)) {}
  const std::type_info& type() const override { return typeid(T); }
  void add_to(WorkingSet& set) const override;

  bool has_number(std::string_view path) const override {
    double ignored = 0;
    return read_number(T{}, path, ignored) != FieldOutcome::unknown;
  }
  PosterStatus read_numbers(std::span<FieldReading> readings, Time& date) const override {
    const std::lock_guard guard(mutex_);
    return numbers(readings, date);
  }
  PosterStatus look_numbers(std::span<FieldReading> readings, Time& date) const override {
    const threads::observer_lock guard(mutex_);
    return numbers(readings, date);
  }

  /// Publishes a new value. Only for the poster's writer.
  void write(const T& value) {
    const std::lock_guard guard(mutex_);
    value_ = value;
    ++writes_;
    was_read_ = false;
    date_ = threads::now();
    threads::record(name_hash_, value);
  }

  /// Copies the value out, and the date of its write to `date` unless null.
  PosterStatus read(T& value, Time* date = nullptr) const {
    const std::lock_guard guard(mutex_);
    if (writes_ == 0) return PosterStatus::empty;
    was_read_ = true;
    value = value_;
    if (date != nullptr) *date = date_;
    return PosterStatus::ok;
  }

  bool read_c(void* to, std::size_t size) const override {
    if constexpr (requires { typename T::CType; }) {
      T value;
      if (read(value) == PosterStatus::empty) return false;
      threads::access_hardware(latency_);
      typename T::CType c{};
      value.to(c);
      std::memcpy(to, &c, std::min(size, sizeof c));
      return true;
    }
    return false;
  }

  std::optional<std::string> read_text() const override {
    const auto value = std::make_unique<T>();  // may be larger than a stack
    const PosterStatus status = read(*value);
    threads::access_hardware(latency());
    return status == PosterStatus::ok ? std::optional(text_of(*value)) : std::nullopt;
  }

  FieldShape shape() const override { return shape_of<T>(); }
  std::optional<std::string> look_text() const override {
    const threads::observer_lock guard(mutex_);
    return writes_ > 0 ? std::optional(text_of(value_)) : std::nullopt;
  }

  /// The value for an observer outside the robot's software; nothing if empty. No event in simulation.
  std::optional<T> look() const {
    const threads::observer_lock guard(mutex_);
    return writes_ > 0 ? std::optional(value_) : std::nullopt;
  }

 private:
  PosterStatus numbers(std::span<FieldReading> readings, Time& date) const {
    if (writes_ == 0) return PosterStatus::empty;
    for (FieldReading& reading : readings) reading.outcome = read_number(value_, reading.path, reading.number);
    date = date_;
    return PosterStatus::ok;
  }

  T value_{};
};

template <HasFields T>
void Poster<T>::add_to(WorkingSet& set) const {
  constexpr std::size_t of_value_max = 192;
  set.add_between(&mutex_, reinterpret_cast<const char*>(&value_) + std::min(sizeof value_, of_value_max));
}

/// A module's declaration that it reads a poster; connected by name when the robot is assembled.
class PosterLinkBase {
 public:
  virtual ~PosterLinkBase() = default;
  const std::string& name() const { return name_; }
  virtual const std::type_info& type() const = 0;
  /// False if `poster` has another type.
  virtual bool connect(PosterBase& poster) = 0;
  /// Adds the memory that every read touches.
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

  /// As Poster::read; an unconnected optional link reads as empty.
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
