// SPDX-License-Identifier: BSD-3-Clause
#include "tools/finding/page_server.hpp"

#include <utility>

#include "tools/view/server/token.hpp"

namespace waitpoint::tools {
namespace {

constexpr int look_ms = 100;
// A client that has so much to take gets no further news until it has.
constexpr std::size_t queued_max = 1 << 20;

}  // namespace

PageServer::PageServer(const ServeAddress& at, std::string page)
    : page_(std::move(page)),
      server_({at.address, at.port, view::make_token(), page_},
              {.opened =
                   [this](view::ClientNumber client) {
                     clients_.insert(client);
                     if (!news_.empty()) server_.send(client, news_);
                   },
               .closed = [this](view::ClientNumber client) { clients_.erase(client); }},
              "--serve") {}

void PageServer::replace(std::string page) {
  page_ = std::move(page);
  server_.set_page(page_);
  tell(R"({"kind":"page"})");
  news_.clear();
}

void PageServer::tell(const std::string& news) {
  news_ = news;
  for (const view::ClientNumber client : clients_)
    if (server_.queued(client) <= queued_max) server_.send(client, news);
}

void PageServer::serve(const std::function<bool()>& is_over) {
  server_.repeat(look_ms, [this, &is_over] {
    if (is_over()) server_.stop();
  });
  server_.run();
}

}  // namespace waitpoint::tools
