// SPDX-License-Identifier: BSD-3-Clause
// The event loop of one thread: descriptors that others read, times, and the connections of a web server.
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/steady_timer.hpp>
#include <functional>
#include <list>
#include <map>
#include <memory>

namespace waitpoint::tools::view {

class EventLoop {
 public:
  boost::asio::io_context& context() { return context_; }

  /// Calls `ready` whenever the descriptor, which stays the caller's, can be read, until it is forgotten.
  void watch(int descriptor, std::function<void()> ready);
  void forget(int descriptor);
  /// Calls `action` again and again.
  void repeat(int milliseconds, std::function<void()> action);

  /// Until stop().
  void run() { context_.run(); }
  void stop() { context_.stop(); }

 private:
  struct Watched : std::enable_shared_from_this<Watched> {
    Watched(boost::asio::io_context& context, int number, std::function<void()> ready)
        : descriptor(context, number), ready(std::move(ready)) {}
    ~Watched() { descriptor.release(); }
    void wait();

    boost::asio::posix::stream_descriptor descriptor;
    std::function<void()> ready;
    bool is_forgotten = false;
  };

  struct Repeated {
    Repeated(boost::asio::io_context& context, int milliseconds, std::function<void()> action)
        : timer(context), period(milliseconds), action(std::move(action)) {}
    void wait();

    boost::asio::steady_timer timer;
    std::chrono::milliseconds period;
    std::function<void()> action;
  };

  boost::asio::io_context context_{1};
  std::map<int, std::shared_ptr<Watched>> watched_;
  std::list<Repeated> repeated_;
};

}  // namespace waitpoint::tools::view
