// SPDX-License-Identifier: BSD-3-Clause
// A page for browsers that may be replaced: those who have it open are told to load the new one. Before that it may be
// told of news, of which who comes later gets the last.
#pragma once

#include <functional>
#include <set>
#include <string>

#include "tools/command/serve_address.hpp"
#include "tools/view/server/web_server.hpp"

namespace waitpoint::tools {

class PageServer {
 public:
  /// Listens; BadInput names --serve.
  PageServer(const ServeAddress& at, std::string page);

  std::string url() const { return server_.url(); }
  /// Shows another page.
  void replace(std::string page);
  /// News in JSON.
  void tell(const std::string& news);
  /// Calls `ready` whenever the descriptor can be read, until it is forgotten.
  void watch(int descriptor, std::function<void()> ready) { server_.watch(descriptor, std::move(ready)); }
  void forget(int descriptor) { server_.forget(descriptor); }
  /// Until `is_over`, which is called ten times a second, returns true.
  void serve(const std::function<bool()>& is_over);

 private:
  std::string page_, news_;
  view::WebServer server_;
  std::set<view::ClientNumber> clients_;
};

}  // namespace waitpoint::tools
