// SPDX-License-Identifier: BSD-3-Clause
// The keys of a temporal plan's file.
#pragma once

#include "modules/scenario/keys.hpp"

namespace waitpoint::plan {

inline constexpr std::uint64_t amount_max = 1'000'000;
/// The greatest number of actions of a plan.
inline constexpr std::size_t actions_max = 200;
inline constexpr NumberRange any_number{-1e12, 1e12, "a number from -1e12 to 1e12"};
inline constexpr std::string_view action_kinds[] = {"controllable", "contingent"};

const scenario::KeyTable& plan_keys();
const scenario::KeyTable& action_keys();
const scenario::KeyTable& request_keys();
const scenario::KeyTable& condition_keys();
const scenario::KeyTable& resource_keys();
const scenario::KeyTable& constraint_keys();
const scenario::KeyTable& alternative_keys();

}  // namespace waitpoint::plan
