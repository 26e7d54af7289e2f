// SPDX-License-Identifier: BSD-3-Clause
#include "tools/view/server/event_loop.hpp"

namespace waitpoint::tools::view {

using boost::system::error_code;

void EventLoop::Watched::wait() {
  descriptor.async_wait(boost::asio::posix::descriptor_base::wait_read, [self = shared_from_this()](error_code error) {
    if (error || self->is_forgotten) return;
    self->ready();
    if (!self->is_forgotten) self->wait();
  });
}

void EventLoop::Repeated::wait() {
  timer.expires_after(period);
  timer.async_wait([this](error_code error) {
    if (error) return;
    action();
    wait();
  });
}

void EventLoop::watch(int descriptor, std::function<void()> ready) {
  const auto watched = std::make_shared<Watched>(context_, descriptor, std::move(ready));
  watched_[descriptor] = watched;
  watched->wait();
}

void EventLoop::forget(int descriptor) {
  const auto found = watched_.find(descriptor);
  if (found == watched_.end()) return;
  found->second->is_forgotten = true;
  // Its wait must not outlive the descriptor, whose number another file may get.
  found->second->descriptor.release();
  watched_.erase(found);
}

void EventLoop::repeat(int milliseconds, std::function<void()> action) {
  repeated_.emplace_back(context_, milliseconds, std::move(action)).wait();
}

}  // namespace waitpoint::tools::view
