// SPDX-License-Identifier: BSD-3-Clause
// The writing side of a module's poster: a codel's write is published after the codel's cost has been added.
#pragma once

#include <functional>

#include "modules/genom/poster.hpp"

namespace waitpoint::genom {

class OutputPosterBase {
 public:
  virtual ~OutputPosterBase() = default;
  /// Copies the automatic source, if there is one. Called at the end of every wake-up.
  virtual void update() = 0;
  /// Adds the memory that give() touches.
  virtual void add_to(WorkingSet& set) const = 0;
  /// Publishes the last value written, if there is a new one.
  void give() {
    if (!written_) return;  // the common case: called after every codel
    written_ = false;
    give_staged();
  }

 protected:
  void has_written() { written_ = true; }

 private:
  virtual void give_staged() = 0;

  bool written_ = false;
};

template <HasFields T>
class OutputPoster : public OutputPosterBase {
 public:
  /// `automatic`, if not null, is copied to the poster at the end of every wake-up of its task.
  OutputPoster(Poster<T>& poster, const T* automatic) : poster_(poster), automatic_(automatic) {}
  /// `compute` makes its value at the end of every wake-up of its task.
  OutputPoster(Poster<T>& poster, std::function<void(T& value)> compute)
      : poster_(poster), compute_(std::move(compute)) {}

  /// Only from codels of the poster's task.
  void write(const T& value) {
    staged_ = value;
    has_written();
  }
  void update() override {
    if (automatic_ != nullptr) write(*automatic_);
    if (!compute_) return;
    compute_(staged_);
    has_written();
  }
  void add_to(WorkingSet& set) const override {
    set.add(this, std::min(sizeof *this, small));
    poster_.add_to(set);
  }

 private:
  static constexpr std::size_t small = 256;

  void give_staged() override {
    threads::access_hardware(poster_.latency());
    poster_.write(staged_);
  }

  Poster<T>& poster_;
  const T* automatic_ = nullptr;
  std::function<void(T&)> compute_;
  T staged_{};
};

}  // namespace waitpoint::genom
