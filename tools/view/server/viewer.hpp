// SPDX-License-Identifier: BSD-3-Clause
// The process that shows a run to browsers: it serves the page, asks the run for frames as fast as its clients take
// them, and the history (history.hpp) for questions about the past. The run is never held up by a client: one
// that is slow gets fewer frames.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tools/view/history/history.hpp"
#include "tools/view/server/web_server.hpp"

namespace waitpoint::tools::view {

struct ViewerOptions {
  std::string address = "127.0.0.1";
  std::uint16_t port = 0;
  Time until;                  ///< the end of the run at the latest
  bool is_controlled = false;  ///< clients may pause and pace the run, and make branches
  std::string replay_command;  ///< of a journal, which the page shows: "waitpoint run S.yaml --seed 1"
};

class Viewer {
 public:
  /// Listens; BadInput names the option --serve.
  Viewer(const ViewerOptions& options, Channel run);

  std::string url() const { return server_.url(); }
  /// The run waits for this.
  void begin_run() { run_.queue("{}"); }
  /// Until `is_over`, which is called ten times a second, returns true. The run has its own process.
  void serve(const std::function<bool()>& is_over);

 private:
  struct Client {
    bool follows = false;
    bool is_behind = false;       // it has not got all that further frames leave out
    Json wants = Json::object();  // members of frame_options()
    double frame_s = 0;           // least time between frames
    double next_s = 0;            // when it may get the next one
    History::Reply header;        // that it waits for, before the run has begun
  };

  void take_from_run();
  void take(Channel::Message& message);
  bool is_ready(ClientNumber number, const Client& client, double now_s) const;
  void ask_for_frame();
  void received(ClientNumber client, const std::string& text);
  void answer(ClientNumber client, const Json& request, const History::Reply& reply);
  void answer_journal(ClientNumber client, const Json& request, const History::Reply& reply);
  void send_header(ClientNumber client, const History::Reply& reply);
  void compare(ClientNumber client, const Json& request, const History::Reply& reply);
  void follow(Client& client, const Json& request);
  void control(const Json& request, const History::Reply& reply);
  void send_frame(const std::string& text);
  void send_status();
  void send_to_all(const std::string& text);

  ViewerOptions options_;
  Channel run_;
  WebServer server_;
  History history_;
  std::map<ClientNumber, Client> clients_;
  std::string scene_, log_;  // as the run sent them
  std::size_t robots_ = 0;
  Json status_ = Json::object();
  std::string sent_status_;  // the last status that clients got
  bool frame_is_due_ = false, run_is_over_ = false;
};

}  // namespace waitpoint::tools::view
