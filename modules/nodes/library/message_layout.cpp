// SPDX-License-Identifier: BSD-3-Clause
#include "modules/nodes/library/message_layout.hpp"

#include <algorithm>
#include <cstring>
#include <sstream>
#include <stdexcept>

namespace waitpoint::nodes {
namespace {

template <class T>
double number_at(const std::uint8_t* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return static_cast<double>(value);
}

struct Primitive {
  std::size_t bytes;
  double (*value)(const std::uint8_t*);
};

double time_at(const std::uint8_t* at) {
  return number_at<std::uint32_t>(at) + 1e-9 * number_at<std::uint32_t>(at + 4);
}
double duration_at(const std::uint8_t* at) {
  return number_at<std::int32_t>(at) + 1e-9 * number_at<std::int32_t>(at + 4);
}

const Primitive* primitive(const std::string& type) {
  static const std::map<std::string, Primitive> all = {
      {"bool", {1, number_at<std::uint8_t>}},
      {"byte", {1, number_at<std::int8_t>}},
      {"char", {1, number_at<std::uint8_t>}},
      {"int8", {1, number_at<std::int8_t>}},
      {"uint8", {1, number_at<std::uint8_t>}},
      {"int16", {2, number_at<std::int16_t>}},
      {"uint16", {2, number_at<std::uint16_t>}},
      {"int32", {4, number_at<std::int32_t>}},
      {"uint32", {4, number_at<std::uint32_t>}},
      {"int64", {8, number_at<std::int64_t>}},
      {"uint64", {8, number_at<std::uint64_t>}},
      {"float32", {4, number_at<float>}},
      {"float64", {8, number_at<double>}},
      {"time", {8, time_at}},
      {"duration", {8, duration_at}},
  };
  const auto found = all.find(type);
  return found == all.end() ? nullptr : &found->second;
}

std::string package_of(const std::string& type) { return type.substr(0, type.find('/')); }

}  // namespace

/// One pass over a message, up to the wanted field.
class MessageLayout::Reading {
 public:
  Reading(const MessageLayout& layout, const std::vector<std::uint8_t>& message, const std::string& wanted)
      : layout_(layout), message_(message), wanted_(wanted) {}

  std::optional<double> run() {
    all("", "", "");
    return found_;
  }

 private:
  const std::uint8_t* take(std::size_t bytes) {
    if (bytes > message_.size() - at_) throw std::out_of_range("a message is shorter than its type");
    at_ += bytes;
    return message_.data() + at_ - bytes;
  }

  std::uint32_t take_count() { return static_cast<std::uint32_t>(number_at<std::uint32_t>(take(4))); }

  void all(const std::string& type, const std::string& package, const std::string& prefix) {
    const std::vector<Field>* const fields = layout_.fields_of(type, package);
    if (fields == nullptr) throw std::out_of_range("a message's definition lacks a type");
    const std::string own = type.empty() ? package : package_of(type.find('/') == type.npos ? package + "/" : type);
    for (const Field& field : *fields) {
      const std::string name = prefix + field.name;
      if (!field.is_array) {
        one(field.type, own, name);
      } else {
        const std::uint32_t count = field.count ? *field.count : take_count();
        const Primitive* const number = primitive(field.type);
        if (number != nullptr && wanted_.compare(0, name.size() + 1, name + "[") != 0) {
          take(number->bytes * count);
          continue;
        }
        for (std::uint32_t i = 0; i < count && !found_; ++i) one(field.type, own, name + "[" + std::to_string(i) + "]");
      }
      if (found_) return;
    }
  }

  void one(const std::string& type, const std::string& package, const std::string& name) {
    if (type == "string") {
      take(take_count());
    } else if (const Primitive* const number = primitive(type); number != nullptr) {
      const std::uint8_t* const bytes = take(number->bytes);
      if (name == wanted_) found_ = number->value(bytes);
    } else {
      all(type, package, name + ".");
    }
  }

  const MessageLayout& layout_;
  const std::vector<std::uint8_t>& message_;
  const std::string& wanted_;
  std::size_t at_ = 0;
  std::optional<double> found_;
};

MessageLayout::MessageLayout(const std::string& definition) {
  std::istringstream lines(definition);
  std::string type;
  for (std::string line; std::getline(lines, line);) {
    line.resize(std::min(line.size(), line.find('#')));
    std::istringstream words(line);
    Field field;
    if (!(words >> field.type >> field.name)) continue;
    if (field.type == "MSG:") {
      type = field.name;
      types_[type];  // which may have no fields
      continue;
    }
    std::string rest;
    std::getline(words, rest);
    if ((field.name + rest).find('=') != std::string::npos) continue;  // a constant
    if (const std::size_t bracket = field.type.find('['); bracket != std::string::npos) {
      field.is_array = true;
      const std::string count = field.type.substr(bracket + 1, field.type.size() - bracket - 2);
      if (!count.empty()) field.count = static_cast<std::uint32_t>(std::stoul(count));
      field.type.resize(bracket);
    }
    types_[type].push_back(field);
  }
}

// A type without a package is of the one around it; Header alone is std_msgs's.
const std::vector<MessageLayout::Field>* MessageLayout::fields_of(const std::string& type,
                                                                  const std::string& package) const {
  static const std::vector<Field> none;
  if (type.empty()) return types_.count("") != 0 ? &types_.at("") : &none;
  const bool is_full = type.find('/') != std::string::npos;
  const std::string names[] = {is_full ? type : package + "/" + type, "std_msgs/" + type};
  for (const std::string& name : names) {
    const auto found = types_.find(name);
    if (found != types_.end()) return &found->second;
  }
  // The message's own package is not in its definition.
  for (const auto& [name, fields] : types_)
    if (!is_full && name.size() > type.size() && name.substr(name.find('/') + 1) == type) return &fields;
  return nullptr;
}

std::optional<double> MessageLayout::value(const std::vector<std::uint8_t>& message, const std::string& field) const {
  try {
    return Reading(*this, message, field).run();
  } catch (const std::out_of_range&) {
    return std::nullopt;
  }
}

}  // namespace waitpoint::nodes
