// SPDX-License-Identifier: BSD-3-Clause
#include "modules/genom/control_task.hpp"

#include <algorithm>

#include "modules/genom/codel_end.hpp"

namespace waitpoint::genom {
namespace {

bool names(const std::vector<std::string>& list, const std::string& name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

}  // namespace

void ControlTask::run() {
  for (;;) {
    data_.mailbox.event().acquire();
    const BothLocks locks(data_);
    end_activities();
    Letter letter;
    if (data_.mailbox.take(letter)) {
      handle(letter);
      for (ExecutionTask& task : tasks_) task.signal();
    }
    start_activities();
    write_status();
    if (!data_.ending) continue;
    const bool all_ended = std::all_of(tasks_.begin(), tasks_.end(), [](auto& t) { return t.ended(); });
    if (all_ended) return;
  }
}

void ControlTask::end_activities() {
  for (Activity& a : data_.activities.used()) {
    if (a.state == State::zombie && !a.replied) {
      if (a.report == ok) a.report = data_.report(StandardReport::activity_failed);
      a.replied = true;
      reply(LetterKind::final_reply, a);
    }
    if (a.state != State::ether) continue;
    if (a.interrupted) a.report = data_.report(StandardReport::activity_interrupted);
    if (a.type->kind == RequestKind::init && a.report == ok) init_done_ = true;
    reply(LetterKind::final_reply, a);
    data_.activities.free(a);
  }
}

void ControlTask::handle(const Letter& letter) {
  Payload output;
  if (letter.request >= data_.requests.size() || !data_.requests[letter.request].accepts(letter.payload))
    return reply(LetterKind::final_reply, letter, data_.report(StandardReport::system_error), output);
  const RequestType& type = data_.requests[letter.request];
  tell(LetterKind::request, type);
  if (type.kind == RequestKind::control) {
    threads::this_thread::set_work("the control codel", type.name.c_str());
    const Report report = type.control(letter.payload, output);
    end_codel(data_, "the control codel", type.name);
    threads::compute(type.cost);
    if (report == ok) interrupt_incompatible(type);
    return reply(LetterKind::final_reply, letter, report, output);
  }
  const Report report = execute(type, letter);
  if (report != ok) reply(LetterKind::final_reply, letter, report, output);
}

// Allocates an activity; it starts when the activities that it interrupts have ended.
Report ControlTask::execute(const RequestType& type, const Letter& letter) {
  if (data_.ending || type.task->ended()) return data_.report(StandardReport::system_error);
  for (const ExecutionTask& task : tasks_)
    if (task.suspended()) return data_.report(StandardReport::exec_task_suspended);
  if (!init_done_ && type.kind != RequestKind::init) return data_.report(StandardReport::wait_init_request);
  ActivityTable& table = data_.activities;
  for (const Activity& a : table.used())
    if (a.state == State::zombie) return data_.report(StandardReport::wait_abort_zombie_activity);
  if (table.full()) return data_.report(StandardReport::too_many_activities);
  Payload output;
  threads::this_thread::set_work("the control codel", type.name.c_str());
  const Report checked = type.control(letter.payload, output);
  end_codel(data_, "the control codel", type.name);
  if (checked != ok) return checked;
  interrupt_incompatible(type);
  Activity& a = table.add(*type.task);
  a.state = State::init;
  a.type = &type;
  a.send_id = letter.send_id;
  a.client = letter.reply_to;
  a.input = letter.payload;
  return ok;
}

void ControlTask::interrupt_incompatible(const RequestType& type) {
  for (Activity& a : data_.activities.used())
    if (names(type.interrupts, a.type->name)) interrupt(a);
}

bool ControlTask::interruptible(State state) const {
  return state == State::start || state == State::exec || state == State::sleep ||
         (state == State::end && interrupt_end_);
}

void ControlTask::interrupt(Activity& a) {
  if (a.state == State::init) {
    a.report = data_.report(StandardReport::activity_interrupted);
    reply(LetterKind::final_reply, a);
    data_.activities.free(a);
  } else if (a.state == State::zombie) {
    data_.activities.free(a);
  } else if (interruptible(a.state)) {
    a.interrupt = true;
    a.type->task->signal();
  }
}

Report ControlTask::abort(std::int32_t activity) {
  if (activity == AbortInput::end_module) {
    if (!data_.activities.empty()) return data_.report(StandardReport::system_error);
    data_.ending = true;
    data_.mailbox.event().release();
    return ok;
  }
  if (activity == AbortInput::resume_tasks) {
    for (ExecutionTask& task : tasks_) task.resume();
    return ok;
  }
  if (!ActivityTable::is_number(activity)) return data_.report(StandardReport::unknown_activity);
  Activity* const found = data_.activities.find(activity);
  if (found == nullptr) return data_.report(StandardReport::activity_already_ended);
  interrupt(*found);
  return ok;
}

// True if an activity that `candidate` must wait for is active; a ZOMBIE executes nothing.
bool ControlTask::blocked(const Activity& candidate) const {
  for (const Activity& a : data_.activities.used()) {
    if (&a == &candidate || a.state == State::init || a.state == State::zombie) continue;
    if (names(candidate.type->interrupts, a.type->name)) return true;
  }
  return false;
}

void ControlTask::start_activities() {
  for (Activity& a : data_.activities.used()) {
    if (a.state != State::init || blocked(a)) continue;
    a.state = State::start;
    reply(LetterKind::intermediate_reply, a);
    a.type->task->signal();
  }
}

void ControlTask::write_status() {
  ModuleStatus status;
  for (const Activity& a : data_.activities.used()) status.activities.push_back({a.number, a.type->number, a.state});
  for (const ExecutionTask& task : tasks_) {
    status.missed_periods += static_cast<std::uint64_t>(task.missed_periods());
    status.suspended |= task.suspended();
  }
  poster_.write(status);
}

void ControlTask::reply(LetterKind kind, const Letter& request, Report report, const Payload& output) {
  Letter letter;
  letter.kind = kind;
  letter.request = request.request;
  letter.send_id = request.send_id;
  letter.report = report;
  letter.payload = output;
  if (request.request < data_.requests.size()) tell(kind, data_.requests[request.request], -1, report);
  // A reply to a full mailbox is lost, as in GenoM: the module never waits for a client.
  if (request.reply_to != nullptr) (void)request.reply_to->post(letter);
}

void ControlTask::reply(LetterKind kind, const Activity& activity) {
  Letter letter;
  letter.kind = kind;
  letter.request = activity.type->number;
  letter.send_id = activity.send_id;
  letter.activity = activity.number;
  letter.report = kind == LetterKind::final_reply ? activity.report : ok;
  letter.payload = activity.output;
  tell(kind, *activity.type, activity.number, letter.report);
  if (activity.client != nullptr) (void)activity.client->post(letter);
}

void ControlTask::tell(LetterKind kind, const RequestType& request, std::int32_t activity, Report report) const {
  if (watch_ != nullptr) watch_->on(module_, {threads::now(), kind, request, activity, report});
}

}  // namespace waitpoint::genom
