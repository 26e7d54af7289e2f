// SPDX-License-Identifier: BSD-3-Clause
// What a sequential model of an object under test consists of.
#pragma once

#include <concepts>

namespace waitpoint {

/// A sequential type: a copyable state, with an operation as a value.
template <class Model>
concept SequentialModel = std::copyable<Model> && std::equality_comparable<Model> &&
    std::equality_comparable<typename Model::Result> &&
    requires(Model model, const typename Model::Operation& operation) {
  { model.apply(operation) } -> std::convertible_to<typename Model::Result>;
};

/// A model whose operations on different keys are independent.
template <class Model>
concept KeyedModel = requires(const Model model, const typename Model::Operation& operation) {
  model.key(operation);
};

/// A model with `std::size_t hash() const`, equal for equal states, for long histories: otherwise states are told apart
/// by
/// == alone, among those that the same operations lead to.
template <class Model>
concept HashedModel = requires(const Model model) {
  { model.hash() } -> std::convertible_to<std::size_t>;
};

}  // namespace waitpoint
