// SPDX-License-Identifier: BSD-3-Clause
// The list of all sensor types. Scenarios, worlds, bridges, recordings and documents iterate it at compile time; to add
// a type is to declare it in a header of this folder, to add it to the list, and to write its model (../models.hpp).
//
// A sensor type S declares
//
//   key, noun           its key in a robot type, and its name in messages
//   Description         its parameters as declared fields, with ranges, defaults and what they mean
//   several             true: a list of them in a robot type
//   contradiction(d)    optional: what is wrong with parameters that exclude each other
//
// and, unless another device reports for it (sonars and battery: the base's controller),
//
//   Reading             a value with declared fields, `date` first: the poster of the device value KEY.reading
//   in_world_frame      optional: true if readings are in the world's frame; otherwise they are in the body's
//   Model               the class that makes its readings: models.hpp
//   period(description) if it is read on demand, at that period. Other sensors measure in every step of the world, and
//                       count their readings in Reading::number.
#pragma once

#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <variant>
#include <vector>

#include "world/sensors/types/battery.hpp"
#include "world/sensors/types/bumpers.hpp"
#include "world/sensors/types/gps.hpp"
#include "world/sensors/types/imu.hpp"
#include "world/sensors/types/infrareds.hpp"
#include "world/sensors/types/lasers.hpp"
#include "world/sensors/types/optical_flow.hpp"
#include "world/sensors/types/sonars.hpp"

namespace waitpoint::world {

template <class... Types>
struct SensorList {
  /// Values of `For` the types, in their order.
  template <template <class> class For>
  using Tuple = std::tuple<For<Types>...>;
  template <template <class> class For>
  using Variant = std::variant<For<Types>...>;

  /// Calls `visit.template operator()<S>()` for every type, in order.
  static constexpr void for_each(auto&& visit) { (visit.template operator()<Types>(), ...); }

  template <class... Others>
  SensorList<Types..., Others...> operator+(SensorList<Others...>) const;
};

using Sensors = SensorList<Lasers, Sonars, Bumpers, Infrareds, Imu, Gps, OpticalFlow, Battery>;

/// A body has a list of them.
template <class S>
concept HasSeveral = requires {
  S::several;
};

/// A body has one at most, with a model and a poster of its own: World::read().
template <class S>
concept ReadAlone = !HasSeveral<S> && requires {
  typename S::Reading;
};

/// It is read at the period of its description.
template <class S>
concept ReadOnDemand = ReadAlone<S> && requires(const typename S::Description& description) {
  S::period(description);
};

template <class... Types>
auto read_alone_of(SensorList<Types...>)
    -> decltype((SensorList<>() + ... + std::conditional_t<ReadAlone<Types>, SensorList<Types>, SensorList<>>()));
using SensorsReadAlone = decltype(read_alone_of(Sensors()));

/// The name of a sensor's reading in the bridge's table of a scenario.
template <ReadAlone S>
std::string device_value() {
  std::string name(S::key);
  name.append(".reading");
  return name;
}

/// The reading of a sensor of type S, to be filled.
template <class S>
struct ReadingOut {
  typename S::Reading* reading;
};
using AnyReadingOut = SensorsReadAlone::Variant<ReadingOut>;

/// The descriptions of a body's sensors of type S.
template <class S>
using DescriptionsOf =
    std::conditional_t<HasSeveral<S>, std::vector<typename S::Description>, std::optional<typename S::Description>>;

/// The descriptions of all sensors of a body.
class Equipment {
 public:
  template <class S>
  DescriptionsOf<S>& of() {
    return std::get<DescriptionsOf<S>>(descriptions_);
  }
  template <class S>
  const DescriptionsOf<S>& of() const {
    return std::get<DescriptionsOf<S>>(descriptions_);
  }

 private:
  Sensors::Tuple<DescriptionsOf> descriptions_;
};

}  // namespace waitpoint::world
