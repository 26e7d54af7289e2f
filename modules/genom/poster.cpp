// SPDX-License-Identifier: BSD-3-Clause
#include "modules/genom/poster.hpp"

#include "core/digest.hpp"

namespace waitpoint::genom {

PosterBase::PosterBase(std::string name, std::string writer)
    : name_(std::move(name)), writer_(std::move(writer)), name_hash_(text_hash(name_)) {}

}  // namespace waitpoint::genom
