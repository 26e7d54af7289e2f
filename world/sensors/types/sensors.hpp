// SPDX-License-Identifier: BSD-3-Clause
// The list of all sensor types. Scenarios, worlds, bridges, recordings and documents iterate it at compile time; to add
// a type is to declare it in a header of this folder, to add it to the list, and to write its model (../models.hpp).
//
// A sensor type S declares
//
//   key, noun           its key in a robot type, and its name in messages
//   Description         its parameters as declared fields, with ranges, defaults and what they mean
//   Reading             a value with declared fields, `date` first: the poster of the device value NAME.reading; NAME
//   is
//                       the key
//   period(description) if it is read on demand, at that period. Other sensors measure in every step of the world, and
//                       count their readings in Reading::number.
//
// and, where this applies,
//
//   several             a robot type has a list of them; NAME is S::device, with a number from the second on, or
//   named               the name in the scenario
//   built_in            every body has one, also without a description
//   in_world_frame      readings are in the world's frame; otherwise they are in the body's, or the description's mount
//   in_turns            a reading continues the one before: every period counts, the first reading is due at once
//   Command             it is off until a poster NAME.command of this type says `on`
//   switched_by_base    it is off until the base's command says so
//   transmission(d)     the time of a reading on a line, from its date to its arrival
//   contradiction(d)    what is wrong with parameters that exclude each other
//   Model               the class that makes its readings: models.hpp. Those of lasers and sonars are made by Senses
//                       (world/kinematic), of all beams at once, those of the battery by the vehicle that it drives
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

template <class S>
concept HasModel = requires {
  typename S::Model;
};

/// It is read at the period of its description.
template <class S>
concept ReadOnDemand = requires(const typename S::Description& description) {
  S::period(description);
};

template <class S>
concept HasCommand = requires {
  typename S::Command;
};

template <class S>
concept StartsOff = HasCommand<S> || requires {
  S::switched_by_base;
};

template <class S>
concept HasLine = requires(const typename S::Description& description) {
  S::transmission(description);
};

template <class... Types>
auto modelled_of(SensorList<Types...>)
    -> decltype((SensorList<>() + ... + std::conditional_t<HasModel<Types>, SensorList<Types>, SensorList<>>()));
using SensorsWithModel = decltype(modelled_of(Sensors()));

/// The reading of a sensor of type S, to be filled.
template <class S>
struct ReadingOut {
  typename S::Reading* reading;
};
using AnyReadingOut = Sensors::Variant<ReadingOut>;

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
  /// How many sensors of type S the body has.
  template <class S>
  std::size_t count() const {
    if constexpr (HasSeveral<S>)
      return of<S>().size();
    else
      return requires { S::built_in; }
    || of<S>() ? 1 : 0;
  }
  /// The description of one of them.
  template <class S>
  typename S::Description description(std::size_t number) const {
    if constexpr (HasSeveral<S>)
      return of<S>()[number];
    else
      return of<S>().value_or(typename S::Description());
  }

 private:
  Sensors::Tuple<DescriptionsOf> descriptions_;
};

}  // namespace waitpoint::world
