// SPDX-License-Identifier: BSD-3-Clause
// Tcl's commands of events and output in virtual time: after, vwait, update, puts, exit.
#include <algorithm>
#include <utility>

#include "modules/tcl/library/task_interpreter.hpp"

namespace waitpoint::tcl {
namespace {

std::string joined(Tcl_Interp* tcl, std::span<Tcl_Obj* const> words) {
  if (words.size() == 1) return Tcl_GetString(words[0]);
  Tcl_Obj* const text = Tcl_ConcatObj(static_cast<int>(words.size()), words.data());
  Tcl_IncrRefCount(text);
  std::string result = Tcl_GetString(text);
  Tcl_DecrRefCount(text);
  (void)tcl;
  return result;
}

char* note_write(ClientData data, Tcl_Interp*, const char*, const char*, int) {
  *static_cast<bool*>(data) = true;
  return nullptr;
}

}  // namespace

int TaskInterpreter::after(Words words) {
  if (words.size() < 2) return usage(words, "ms|idle|cancel|info ?argument ...?");
  const std::string_view first = Tcl_GetString(words[1]);
  if (first == "cancel") return cancel(words);
  if (first == "info") {
    std::string names;
    for (const Timer& timer : timers_) names += (names.empty() ? "after#" : " after#") + std::to_string(timer.number);
    return succeed(names);
  }
  Tcl_WideInt ms = 0;
  constexpr Tcl_WideInt ms_max = 1'000'000'000'000;
  const bool is_idle = first == "idle";
  if (is_idle && words.size() < 3) return usage(words, "idle script ?script ...?");
  if (!is_idle && Tcl_GetWideIntFromObj(tcl_, words[1], &ms) != TCL_OK)
    return fail("expected a number of milliseconds, idle, cancel or info, found '" + std::string(first) + "'");
  const Time due = link_.now() + std::chrono::milliseconds(std::clamp<Tcl_WideInt>(ms, 0, ms_max));
  if (words.size() == 2) {
    link_.sleep_until(due);
    return succeed("");
  }
  const Timer timer{due, timers_made_++, joined(tcl_, words.subspan(2)), is_idle};
  timers_.insert(std::upper_bound(timers_.begin(), timers_.end(), due,
                                  [](Time time, const Timer& other) { return time < other.due; }),
                 timer);
  return succeed("after#" + std::to_string(timer.number));
}

int TaskInterpreter::cancel(Words words) {
  if (words.size() < 3) return usage(words, "cancel id|script");
  const std::string what = joined(tcl_, words.subspan(2));
  const auto found = std::find_if(timers_.begin(), timers_.end(), [&](const Timer& timer) {
    return "after#" + std::to_string(timer.number) == what || timer.script == what;
  });
  if (found != timers_.end()) timers_.erase(found);
  return succeed("");
}

std::optional<Time> TaskInterpreter::next_timer() const {
  for (const Timer& timer : timers_)
    if (!timer.idle) return timer.due;
  return std::nullopt;
}

bool TaskInterpreter::may_still_happen() const {
  return !timers_.empty() ||
         std::any_of(sent_.begin(), sent_.end(), [](const auto& entry) { return entry.second.ack.has_value(); });
}

int TaskInterpreter::evaluate_callback(const std::string& script) {
  const int result = Tcl_EvalEx(tcl_, script.data(), static_cast<int>(script.size()), TCL_EVAL_GLOBAL);
  return result == TCL_ERROR ? TCL_ERROR : TCL_OK;
}

// Evaluates one callback, waiting for its event until `limit`; false if there was none. With `idle`, also one of those
// that wait for nothing else to do.
bool TaskInterpreter::do_one_event(bool idle, Time limit, int& result) {
  while (receive(Duration())) {
  }
  for (;;) {
    if (!acknowledged_.empty()) {
      const std::uint32_t id = acknowledged_.front();
      acknowledged_.pop_front();
      const Sent sent = std::move(sent_.at(id));
      sent_.erase(id);
      Tcl_DString call;
      Tcl_DStringInit(&call);
      Tcl_DStringAppend(&call, sent.ack->c_str(), -1);
      for (const std::string& word : {sent.name, sent.final->report, sent.final->output})
        Tcl_DStringAppendElement(&call, word.c_str());
      result = evaluate_callback(Tcl_DStringValue(&call));
      Tcl_DStringFree(&call);
      return true;
    }
    const Time now = link_.now();
    const auto due = std::find_if(timers_.begin(), timers_.end(),
                                  [&](const Timer& timer) { return timer.idle ? idle : timer.due <= now; });
    if (due != timers_.end()) {
      const std::string script = std::move(due->script);
      timers_.erase(due);
      result = evaluate_callback(script);
      return true;
    }
    if (now >= limit) return false;
    const Time next = std::min(limit, next_timer().value_or(Time::max()));
    receive(next < Time::max() ? next - now : Duration::max());
  }
}

// Those that there are now: one that asks for itself again waits for the next time, as by Tcl.
void TaskInterpreter::do_idle_tasks(int& result) {
  const std::uint64_t end = timers_made_;
  while (result == TCL_OK && thrown_ == nullptr && !exited_) {
    const auto task = std::find_if(timers_.begin(), timers_.end(),
                                   [&](const Timer& timer) { return timer.idle && timer.number < end; });
    if (task == timers_.end()) return;
    const std::string script = std::move(task->script);
    timers_.erase(task);
    result = evaluate_callback(script);
  }
}

int TaskInterpreter::vwait(Words words) {
  if (words.size() != 2) return usage(words, "name");
  const char* const name = Tcl_GetString(words[1]);
  bool is_written = false;
  constexpr int kinds = TCL_GLOBAL_ONLY | TCL_TRACE_WRITES | TCL_TRACE_UNSETS;
  if (Tcl_TraceVar(tcl_, name, kinds, note_write, &is_written) != TCL_OK) return TCL_ERROR;
  int result = TCL_OK;
  while (!is_written && result == TCL_OK && thrown_ == nullptr && !exited_) {
    if (!may_still_happen()) {
      result = fail("can't wait for variable \"" + std::string(name) + "\": would wait forever");
      break;
    }
    do_one_event(true, Time::max(), result);
  }
  Tcl_UntraceVar(tcl_, name, kinds, note_write, &is_written);
  return result == TCL_OK ? succeed("") : result;
}

int TaskInterpreter::update(Words words) {
  if (words.size() > 2) return usage(words, "?idletasks?");
  constexpr const char* options[] = {"idletasks", nullptr};
  int option = 0;
  if (words.size() == 2 && Tcl_GetIndexFromObj(tcl_, words[1], options, "option", 0, &option) != TCL_OK)
    return TCL_ERROR;
  int result = TCL_OK;
  if (words.size() == 2) {
    do_idle_tasks(result);
    return result == TCL_OK ? succeed("") : result;
  }
  while (result == TCL_OK && thrown_ == nullptr && !exited_ && do_one_event(true, link_.now(), result)) {
  }
  return result == TCL_OK ? succeed("") : result;
}

// To the standard channels: lines of the run's log. To others: Tcl's own.
int TaskInterpreter::puts(Words words) {
  const bool has_no_newline = words.size() > 1 && std::string_view(Tcl_GetString(words[1])) == "-nonewline";
  const Words rest = words.subspan(std::min<std::size_t>(words.size(), has_no_newline ? 2 : 1));
  if (rest.empty() || rest.size() > 2) return usage(words, "?-nonewline? ?channelId? string");
  const std::string_view channel = rest.size() == 2 ? Tcl_GetString(rest[0]) : "stdout";
  if (channel != "stdout" && channel != "stderr") {
    std::vector<Tcl_Obj*> own(words.begin(), words.end());
    own[0] = Tcl_NewStringObj("::waitpoint::puts_to_channel", -1);
    Tcl_IncrRefCount(own[0]);
    const int result = Tcl_EvalObjv(tcl_, static_cast<int>(own.size()), own.data(), 0);
    Tcl_DecrRefCount(own[0]);
    return result;
  }
  line_ += Tcl_GetString(rest.back());
  if (!has_no_newline) line_ += '\n';
  for (std::size_t end = 0; (end = line_.find('\n')) != std::string::npos;) {
    const std::string line = line_.substr(0, end);
    line_.erase(0, end + 1);
    link_.say(line);
  }
  return succeed("");
}

// Ends the script, not the run.
int TaskInterpreter::exit(Words words) {
  if (words.size() > 2) return usage(words, "?status?");
  exited_ = true;
  return unwind();
}

}  // namespace waitpoint::tcl
