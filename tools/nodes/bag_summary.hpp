// SPDX-License-Identifier: BSD-3-Clause
// Results of a bag that was played to nodes: counts and digests of the messages that nodes published, and of their
// files.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/digest.hpp"
#include "modules/nodes/bag_run.hpp"
#include "modules/scenario/scenario.hpp"

namespace waitpoint::tools {

/// The files that nodes are to write.
class NodeOutputs {
 public:
  struct File {
    std::string name;
    std::uint64_t bytes = 0;
    std::optional<Digest> digest;  ///< none: it was not written
  };

  /// Before the run. `names` must outlive this.
  explicit NodeOutputs(const std::vector<std::string>& names);
  /// After it.
  std::vector<File> read() const;

 private:
  const std::vector<std::string>& names_;
  std::vector<std::string> states_;  // before
};

/// Ends with a newline.
std::string bag_summary(const scenario::Scenario& scenario, std::uint64_t seed, const nodes::BagResult& result,
                        const std::vector<NodeOutputs::File>& files);

}  // namespace waitpoint::tools
