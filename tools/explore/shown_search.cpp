// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/shown_search.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <system_error>

#include "tools/command/interruption.hpp"
#include "tools/command/serve_address.hpp"
#include "tools/command/shell_words.hpp"
#include "tools/command/shown_process.hpp"
#include "tools/finding/finding_page.hpp"
#include "tools/finding/page_server.hpp"
#include "tools/view/view_json.hpp"

namespace waitpoint::tools {
namespace {

using view::Json;

constexpr int refused = 2;  // the status of a search for bad input

std::string title_of(const ExploreOptions& options) {
  return options.program.empty() || options.has_nodes ? options.scenario.stem().string()
                                                      : quoted(options.program).substr(1);
}

/// What the search sends.
class Sent {
 public:
  Sent(view::Channel& search, PageServer& server) : search_(search), server_(server) {}

  void take() {
    while (const auto message = search_.poll()) {
      any_ = true;
      if (message->text.starts_with("{\"finding\""))
        server_.replace(page_of_finding(message->text));
      else
        server_.tell(message->text);
    }
    if (!search_.is_open()) server_.forget(search_.number());
  }
  bool any() const { return any_; }

 private:
  view::Channel& search_;
  PageServer& server_;
  bool any_ = false;
};

}  // namespace

void SearchViewers::listen_to(SearchProgress& progress) {
  progress.listen([this](const SearchNews& news) {
    viewers_.send(view::text_of({{"kind", "search"},
                                 {"schedules", news.schedules},
                                 {"distinct", news.distinct},
                                 {"failures", news.failures},
                                 {"seconds", view::rounded(news.seconds)},
                                 {"words", news.words},
                                 {"over", false}}));
  });
}

void SearchViewers::show(const std::string& finding) { viewers_.send(finding); }

void SearchViewers::end(const std::string& words) {
  viewers_.send(view::text_of({{"kind", "search"}, {"words", words}, {"over", true}}));
}

int show_search(const ExploreOptions& options, const std::function<int(view::Channel& viewers)>& search) {
  const ServeAddress& at = *options.serve;
  auto [here, there] = view::Channel::make();
  std::fflush(nullptr);
  const pid_t process = fork();
  if (process < 0) throw std::system_error(errno, std::generic_category(), "a process for the search");
  if (process == 0) {
    ShownProcess::end_with_parent();
    here = view::Channel(view::Descriptor());
    if (!there.receive()) _exit(0);  // the server cannot listen, and says so
    return search(there);
  }
  there = view::Channel(view::Descriptor());
  heed_signals();
  const Json about = {{"search", {{"title", title_of(options)}, {"seed", options.seed}}}};
  PageServer server(at, page_of_finding(view::text_of(about)));
  const std::string url = server.url();
  std::fprintf(stderr, "waitpoint: the search is shown at %s\n", url.c_str());
  here.send("{}");
  Sent sent(here, server);
  server.watch(here.number(), [&] { sent.take(); });
  ShownProcess of_search(process, "search");
  server.serve([&] {
    return of_search.is_done(url) || (of_search.has_ended() && of_search.status() == refused && !sent.any());
  });
  ShownProcess::end_others();
  return of_search.status();
}

}  // namespace waitpoint::tools
