// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/laas/pocolibs/mailboxes.hpp"

#include <algorithm>

#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/laas/include/h2devLib.h"

namespace waitpoint::laas {

void Mailbox::push(int from, const char* text, int bytes) {
  messages.push_back({from, {text, text + bytes}});
  used += ring_bytes(bytes);
}

void Mailbox::pop() {
  used -= ring_bytes(static_cast<int>(messages.front().text.size()));
  messages.pop_front();
}

void Mailbox::clear() {
  messages.clear();
  used = 0;
}

Mailbox& Mailboxes::open(int device, const char* name, int size, long owner) {
  if (closed_.empty()) closed_.push_back(&all_.emplace_back());
  Mailbox& mailbox = *closed_.back();
  closed_.pop_back();
  sync::enter_run(mailbox.object);
  mailbox.name = name;
  mailbox.object.label = mailbox.name.c_str();
  mailbox.device = device;
  mailbox.size = size;
  mailbox.owner = owner;
  by_device_[device] = &mailbox;
  return mailbox;
}

void Mailboxes::close(Mailbox& mailbox) {
  by_device_.erase(mailbox.device);
  mailbox.clear();
  ++mailbox.generation;
  closed_.push_back(&mailbox);
  kernel::wake_all(*sync::running_task().scheduler, mailbox.object);
}

Mailbox* Mailboxes::find(int device) {
  const auto found = by_device_.find(device);
  return found == by_device_.end() ? nullptr : found->second;
}

std::vector<int> Mailboxes::of_task(long owner) const {
  std::vector<int> devices;
  for (const auto& [device, mailbox] : by_device_)
    if (mailbox->owner == owner) devices.push_back(device);
  std::sort(devices.begin(), devices.end(), [](int a, int b) { return H2DEV_INDEX(a) < H2DEV_INDEX(b); });
  return devices;
}

}  // namespace waitpoint::laas
