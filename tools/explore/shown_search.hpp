// SPDX-License-Identifier: BSD-3-Clause
// A search that browsers can look at: how far it is, and its finding once it is there. Two processes, the search and
// the server of the page, which knows what the search sends.
#pragma once

#include <functional>
#include <string>

#include "tools/explore/runs/explore_options.hpp"
#include "tools/explore/search/search_progress.hpp"
#include "tools/view/history/channel.hpp"

namespace waitpoint::tools {

/// The search's end of the connection.
class SearchViewers {
 public:
  explicit SearchViewers(view::Channel& viewers) : viewers_(viewers) {}

  /// Tells of the progress from now on.
  void listen_to(SearchProgress& progress);
  /// The finding's text.
  void show(const std::string& finding);
  /// There is none: the search's last line.
  void end(const std::string& words);

 private:
  view::Channel& viewers_;
};

/// Divides this process. The new one calls `search`, and this returns its status there. The old one serves the page,
/// until Ctrl-C, and returns the status of the search. BadInput, before the search begins, if it cannot listen.
int show_search(const ExploreOptions& options, const std::function<int(view::Channel& viewers)>& search);

}  // namespace waitpoint::tools
