// SPDX-License-Identifier: BSD-3-Clause
#include "modules/genom/poster.hpp"

#include <string_view>

#include "core/digest.hpp"

namespace waitpoint::genom {
namespace {

std::uint64_t hash(const std::string& text) {
  Digest digest;
  digest.add(std::string_view(text));
  return digest.value();
}

}  // namespace

PosterBase::PosterBase(std::string name, std::string writer)
    : name_(std::move(name)), writer_(std::move(writer)), name_hash_(hash(name_)) {}

}  // namespace waitpoint::genom
