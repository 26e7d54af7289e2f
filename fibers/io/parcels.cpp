// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/io/parcels.hpp"

#include "core/error.hpp"

namespace waitpoint::io {

Parcels::~Parcels() {
  while (!under_way_.empty()) drop(under_way_.begin()->first);
}

std::uint64_t Parcels::keep(void* object, Act arrive, Act drop) {
  under_way_.emplace_hint(under_way_.end(), ++last_, Parcel{object, arrive, drop});
  return last_;
}

Parcels::Parcel Parcels::take(std::uint64_t number) {
  const auto found = under_way_.find(number);
  WAITPOINT_CHECK(found != under_way_.end(), "a parcel arrives that is not under way");
  const Parcel parcel = found->second;
  under_way_.erase(found);
  return parcel;
}

void Parcels::arrive(std::uint64_t number) {
  const Parcel parcel = take(number);
  parcel.arrive(parcel.object);
  parcel.drop(parcel.object);
}

void Parcels::drop(std::uint64_t number) {
  const Parcel parcel = take(number);
  parcel.drop(parcel.object);
}

}  // namespace waitpoint::io
