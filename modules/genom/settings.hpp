// SPDX-License-Identifier: BSD-3-Clause
// The settings that a scenario gives to one module, read into structs with declared fields.
//
// A field's name is its key and ends in its unit: "gain", "v_max_m_s"; a Duration's ends in _s, _ms or _us. Elements of
// arrays, points and poses have keys of their own: "gains.0", "via.2.x", "pose.heading" (radians). Unknown keys are
// BadInput, with the nearest known key as a hint. Numbers are bounded by their unit: metres by 1e5, radians by 1000,
// degrees by 3600, metres or radians per second by 1e4, their accelerations by 1e6, seconds by 1e9, volts by 1e5, and
// others by 1e12. A module checks what it expects beyond that.
//
// Settings that describe have no values: they collect a row for each key that is read, for the schema of a module's
// parameters.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/fields.hpp"
#include "core/setting.hpp"

namespace waitpoint::genom {

/// A key that is read.
struct SettingRow {
  enum class Kind : std::uint8_t { truth, integer, number, text, list, map };

  std::string key;
  Kind kind = Kind::text;
  double least = 0, most = 0;  ///< of a number; a list has `most` elements at most, its first one has a row of its own,
                               ///< as keys within a map have
  std::string otherwise;       ///< the default; empty: none
  std::string_view description;
};

class Settings {
 public:
  Settings() = default;
  /// Those that describe.
  static Settings describing();
  explicit Settings(std::vector<Setting> settings) : settings_(std::move(settings)), used_(settings_.size()) {}

  /// Overwrites the fields of `values` that are set; a field's key is `prefix` + its name. A value that does not fit,
  /// or is beyond the field's declared range, is BadInput.
  template <HasFields T>
  void read(T& values, const std::string& prefix = "") {
    T::fields([&](std::string_view name, auto member, const auto&... facts) {
      const std::string key = prefix + std::string(name);
      const FieldFacts known = facts_of(facts...);
      read_described(key, values.*member, known.description);
      if constexpr (std::is_arithmetic_v<std::remove_reference_t<decltype(values.*member)>>) {
        if (known.range) check_within(key, static_cast<double>(values.*member), known.range->low, known.range->high);
        if (known.count)
          check_within(key, static_cast<double>(values.*member), static_cast<double>(known.count->low),
                       static_cast<double>(known.count->high));
      }
    });
  }

  /// The keys read so far of settings that describe.
  const std::vector<SettingRow>& rows() const { return *rows_; }

  bool has(const std::string& key) const;
  /// Adds a number that follows from something else, described by `from`; a module need not read it. If the key is set,
  /// to more than a millionth beside it, BadInput at the setting.
  void derive(const std::string& key, double value, const std::string& from);
  /// Throws BadInput "expected KEY to be `expected`, found ..." at a setting, which must be set.
  [[noreturn]] void reject(const std::string& key, const std::string& expected) const;

  /// Throws BadInput at a setting that made a number of `values` negative; `prefix` as in read().
  template <HasFields T>
  void check_not_negative(const T& values, const std::string& prefix = "") const {
    for_each_field(values, [&](std::string_view name, const auto& member) {
      using Member = std::remove_cvref_t<decltype(member)>;
      const std::string key = prefix + std::string(name);
      if constexpr (HasFields<Member>)
        check_not_negative(member, key + ".");
      else if constexpr (std::is_same_v<Member, double>)
        check_least(key, member, 0);
    });
  }
  /// Throws BadInput at the setting `key` that made `value` less than `least`, or greater than `most`.
  void check_least(const std::string& key, double value, double least) const;
  void check_most(const std::string& key, double value, double most) const;
  /// The same of both, for a setting that is given: the bounds of a declared field.
  void check_within(const std::string& key, double value, double least, double most) const;

  /// Throws BadInput for the first unread setting.
  void check_all_used() const;

  /// Adds a row for a map of keys to settings that describe.
  void describe_map(const std::string& key, std::string_view description = "");

  /// A value that is no declared field; `description` is of static storage.
  template <class T>
  void read_described(const std::string& key, T& value, std::string_view description) {
    const std::size_t before = rows_ == nullptr ? 0 : rows_->size();
    read_one(key, value);
    if (rows_ != nullptr && rows_->size() > before) (*rows_)[before].description = description;
  }
  template <HasFields T>
  void read_one(const std::string& key, T& values) {
    describe_map(key);
    read(values, key + ".");
  }
  void read_one(const std::string& key, double& value);
  void read_one(const std::string& key, bool& value);
  void read_one(const std::string& key, std::string& value);
  void read_one(const std::string& key, Duration& value);
  void read_one(const std::string& key, Time& value);
  void read_one(const std::string& key, Point& value);
  void read_one(const std::string& key, Pose& value);
  template <class T, std::size_t N>
  void read_one(const std::string& key, std::array<T, N>& values) {
    if (rows_ != nullptr) return describe_list(key, N, values[0]);
    for (std::size_t i = 0; i < N; ++i) read_one(element(key, i), values[i]);
  }
  /// A text of C: the letters, and zeros behind them.
  template <std::size_t N>
  void read_one(const std::string& key, std::array<char, N>& text) {
    std::string value;
    read_one(key, value);
    if (value.size() >= N && has(key)) reject(key, "at most " + std::to_string(N - 1) + " letters");
    if (!has(key)) return;
    text = {};
    std::copy(value.begin(), value.end(), text.begin());
  }
  /// If element 0 is set: the elements up to the first that is not; otherwise unchanged.
  template <class T, std::size_t N>
  void read_one(const std::string& key, Bounded<T, N>& values) {
    T first{};
    if (rows_ != nullptr) return describe_list(key, N, first);
    if (has_any(element(key, 0))) values.clear();
    for (std::size_t i = 0; i < N && has_any(element(key, i)); ++i) {
      values.push_back(T{});
      read_one(element(key, i), values[i]);
    }
  }
  template <class Enum>
  requires std::is_enum_v<Enum>
  void read_one(const std::string& key, Enum& value) {
    auto number = static_cast<std::underlying_type_t<Enum>>(value);
    read_one(key, number);
    value = static_cast<Enum>(number);
  }
  template <class Integer>
  requires std::is_integral_v<Integer>
  void read_one(const std::string& key, Integer& value) {
    std::int64_t wide = static_cast<std::int64_t>(value);
    read_integer(key, wide, static_cast<std::int64_t>(std::numeric_limits<Integer>::min()),
                 sizeof(Integer) < 8 ? static_cast<std::int64_t>(std::numeric_limits<Integer>::max())
                                     : std::numeric_limits<std::int64_t>::max());
    value = static_cast<Integer>(wide);
  }

 private:
  static std::string element(const std::string& key, std::size_t i) { return key + "." + std::to_string(i); }
  /// True if the key or one below it is set.
  bool has_any(const std::string& key) const;
  const Setting* take(const std::string& key);
  /// Adds a row to settings that describe.
  void describe(const std::string& key, SettingRow::Kind kind, double least, double most, std::string otherwise);
  template <class T>
  void describe_list(const std::string& key, std::size_t count_max, T& first) {
    describe(key, SettingRow::Kind::list, 0, static_cast<double>(count_max), "");
    read_one(element(key, 0), first);
  }
  SettingRow* row_of(const std::string& key) const;
  void read_integer(const std::string& key, std::int64_t& value, std::int64_t least, std::int64_t most);

  std::vector<Setting> settings_;
  std::vector<bool> used_;
  std::vector<std::string> known_;
  std::shared_ptr<std::vector<SettingRow>> rows_;  ///< null: they do not describe
};

}  // namespace waitpoint::genom
