// SPDX-License-Identifier: BSD-3-Clause
#include "tools/view/event_trace.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "fibers/kernel/run.hpp"
#include "fibers/kernel/watch.hpp"
#include "tools/view/view_json.hpp"

namespace waitpoint::tools::view {
namespace {

template <class Items, class Write>
void append_list(std::string& text, std::string_view name, const Items& items, std::size_t begin, std::size_t end,
                 Write write) {
  fmt::format_to(std::back_inserter(text), ",\"{}\":[", name);
  for (std::size_t i = begin; i < end; ++i) {
    if (i > begin) text += ',';
    write(items[i]);
  }
  text += ']';
}

}  // namespace

EventTrace::EventTrace(kernel::Scheduler& scheduler, std::size_t most)
    : Watch{&EventTrace::see},
      scheduler_(scheduler),
      before_(kernel::watch(scheduler)),
      most_(most),
      first_(kernel::events(scheduler) + 1) {
  kernel::set_watch(scheduler_, this);
}

EventTrace::~EventTrace() { kernel::set_watch(scheduler_, before_); }

void EventTrace::see(kernel::Watch& watch, const kernel::EventRecord& record) {
  EventTrace& self = static_cast<EventTrace&>(watch);
  if (self.before_ != nullptr) self.before_->event(*self.before_, record);
  if (self.times_.size() >= self.most_) {
    self.is_complete_ = false;
    return;
  }
  self.times_.push_back(record.time.ns());
  self.tasks_.push_back(self.number_of(*record.task));
  self.operations_.push_back(static_cast<std::uint8_t>(record.operation));
  self.objects_.push_back(record.object != nullptr ? self.number_of(*record.object) : -1);
}

std::uint32_t EventTrace::number_of(const kernel::Task& task) {
  const auto [at, is_new] = task_numbers_.try_emplace(task.id, static_cast<std::uint32_t>(task_texts_.size()));
  if (is_new) task_texts_.push_back(text_of(Json{task.number, task.name, task.robot->name}));
  return at->second;
}

std::int32_t EventTrace::number_of(const kernel::Object& object) {
  const auto [at, is_new] =
      object_numbers_.try_emplace(object.identity, static_cast<std::int32_t>(object_texts_.size()));
  if (is_new)
    object_texts_.push_back(
        text_of(Json{object.kind, object.number, object.label, object.robot != nullptr ? object.robot->name : ""}));
  return at->second;
}

std::string EventTrace::text(Time from, Time to) const {
  const auto begin =
      static_cast<std::size_t>(std::lower_bound(times_.begin(), times_.end(), from.ns()) - times_.begin());
  const auto end = static_cast<std::size_t>(std::lower_bound(times_.begin(), times_.end(), to.ns()) - times_.begin());
  const bool is_cut = !is_complete_ && !times_.empty() && times_.back() < to.ns();
  std::string text = fmt::format("{{\"kind\":\"events\",\"from\":{},\"to\":{},\"complete\":{},\"first\":{}", from.ns(),
                                 is_cut ? times_.back() : to.ns(), !is_cut, first_ + begin);
  const auto write_text = [&](const std::string& item) { text += item; };
  append_list(text, "tasks", task_texts_, 0, task_texts_.size(), write_text);
  append_list(text, "objects", object_texts_, 0, object_texts_.size(), write_text);
  const auto write_number = [&](auto item) { fmt::format_to(std::back_inserter(text), "{}", item); };
  std::int64_t last = from.ns();
  append_list(text, "t", times_, begin, end, [&](std::int64_t time) {
    write_number(time - last);
    last = time;
  });
  append_list(text, "k", tasks_, begin, end, write_number);
  append_list(text, "o", operations_, begin, end, [&](std::uint8_t operation) { write_number(unsigned{operation}); });
  append_list(text, "x", objects_, begin, end, write_number);
  return text + "}";
}

}  // namespace waitpoint::tools::view
