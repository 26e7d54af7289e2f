// SPDX-License-Identifier: BSD-3-Clause
// Commands of a client of modules: connect, lm, MODULE::REQUEST, MODULE::PosterRead, wait, abort, state.
#include <algorithm>

#include "core/nearest_name.hpp"
#include "modules/tcl/library/input.hpp"
#include "modules/tcl/library/task_interpreter.hpp"

namespace waitpoint::tcl {

// A simulated robot's modules are all there: host and port, if given, have no meaning.
int TaskInterpreter::connect(Words words) {
  if (words.size() > 3) return usage(words, "?host? ?port?");
  return succeed(link_.robot());
}

int TaskInterpreter::load_module(Words words) {
  if (words.size() != 2) return usage(words, "module");
  const std::string module = Tcl_GetString(words[1]);
  const std::vector<std::string> known = link_.modules();
  if (std::find(known.begin(), known.end(), module) == known.end())
    return fail("there is no module '" + module + "'" +
                did_you_mean(module, std::vector<std::string_view>(known.begin(), known.end())));
  if (!loaded_.insert(module).second) return succeed(module);
  Tcl_CreateNamespace(tcl_, ("::" + module).c_str(), nullptr, nullptr);
  for (const RequestShape& shape : link_.requests(module)) {
    RequestCommand& command = request_commands_.emplace_back(RequestCommand{this, module, shape});
    Tcl_CreateObjCommand(tcl_, ("::" + module + "::" + shape.name).c_str(), call_request, &command, nullptr);
  }
  Bound& bound = bound_.emplace_back(Bound{this, &TaskInterpreter::read_poster});
  Tcl_CreateObjCommand(tcl_, ("::" + module + "::PosterRead").c_str(), call, &bound, nullptr);
  return succeed(module);
}

int TaskInterpreter::read_poster(Words words) {
  if (words.size() != 2) return usage(words, "poster");
  std::string module = Tcl_GetString(words[0]);
  module.resize(module.size() - std::string_view("::PosterRead").size());
  if (module.starts_with("::")) module.erase(0, 2);
  const Answer answer = link_.read_poster(module, Tcl_GetString(words[1]));
  return answer.ok ? succeed(answer.text) : fail(answer.text, "POSTER");
}

int TaskInterpreter::request(const RequestCommand& command, Words words) {
  Sent sent{command.module, {}, std::nullopt, -1, std::nullopt};
  bool is_async = false;
  std::size_t at = 1;
  for (; at < words.size(); ++at) {
    const std::string_view word = Tcl_GetString(words[at]);
    if (word == "-async") {
      is_async = true;
    } else if (word == "-ack") {
      if (++at == words.size()) return usage(words, "?-ack script? ?-async? ?argument ...?");
      sent.ack = Tcl_GetString(words[at]);
    } else {
      break;
    }
  }
  std::vector<Setting> input;
  if (!read_input(tcl_, command.shape.input, words.subspan(at), input)) return TCL_ERROR;
  const Answer answer = link_.send(command.module, command.shape.name, input);
  if (!answer.ok) return fail(answer.text);
  const bool is_awaited = !is_async && !sent.ack;
  sent.name = command.module + "::" + command.shape.name + "#" + std::to_string(answer.id);
  const std::string name = sent.name;
  sent_.emplace(answer.id, std::move(sent));
  return is_awaited ? wait_for(answer.id, Time::max()) : succeed(name);
}

TaskInterpreter::Sent* TaskInterpreter::find_sent(Tcl_Obj* name, std::uint32_t& id) {
  const std::string_view text = Tcl_GetString(name);
  for (auto& [number, sent] : sent_) {
    id = number;
    if (sent.name == text) return &sent;
  }
  fail("there is no request '" + std::string(text) + "', or its end has been told");
  return nullptr;
}

bool TaskInterpreter::receive(Duration timeout) {
  const std::optional<ReplyText> reply = link_.receive(timeout);
  if (!reply) return false;
  const auto found = sent_.find(reply->id);
  if (found == sent_.end()) return true;
  found->second.activity = reply->activity;
  if (!reply->final) return true;
  found->second.final = reply;
  if (found->second.ack) acknowledged_.push_back(reply->id);
  return true;
}

int TaskInterpreter::wait_for(std::uint32_t id, Time deadline) {
  while (!sent_.at(id).final) {
    const bool is_bounded = deadline < Time::max();
    if (!receive(is_bounded ? std::max(Duration(), deadline - link_.now()) : Duration::max()) &&
        link_.now() >= deadline)
      return fail(sent_.at(id).name + " has not ended", "TIMEOUT");
  }
  return finish(id);
}

// Result and error of a request that has ended, which is forgotten.
int TaskInterpreter::finish(std::uint32_t id) {
  const Sent sent = std::move(sent_.at(id));
  sent_.erase(id);
  std::erase(acknowledged_, id);
  if (sent.final->ok) return succeed(sent.final->output);
  const std::string request = sent.name.substr(0, sent.name.find('#'));
  const int result = fail(request + ": " + sent.final->report, "REPORT");
  Tcl_SetErrorCode(tcl_, "WAITPOINT", "REPORT", request.c_str(), sent.final->report.c_str(), nullptr);
  return result;
}

int TaskInterpreter::wait(Words words) {
  Time deadline = Time::max();
  const bool has_timeout = words.size() == 4 && std::string_view(Tcl_GetString(words[1])) == "-timeout";
  if (!has_timeout && words.size() != 2) return usage(words, "?-timeout ms? request");
  if (has_timeout) {
    Tcl_WideInt ms = 0;
    constexpr Tcl_WideInt ms_max = 1'000'000'000'000;
    if (Tcl_GetWideIntFromObj(tcl_, words[2], &ms) != TCL_OK) return TCL_ERROR;
    deadline = link_.now() + std::chrono::milliseconds(std::clamp<Tcl_WideInt>(ms, 0, ms_max));
  }
  std::uint32_t id = 0;
  return find_sent(words.back(), id) != nullptr ? wait_for(id, deadline) : TCL_ERROR;
}

// Ends the activity of a request, whose final reply is then ACTIVITY_INTERRUPTED; nothing if it has ended.
int TaskInterpreter::abort(Words words) {
  if (words.size() != 2) return usage(words, "request");
  std::uint32_t id = 0;
  Sent* const sent = find_sent(words[1], id);
  if (sent == nullptr) return TCL_ERROR;
  if (sent->activity < 0 && !sent->final) link_.withdraw(id);
  while (sent->activity < 0 && !sent->final) receive(Duration::max());
  if (sent->final) return succeed("");
  const Answer answer =
      link_.send(sent->module, "Abort", {{"activity", std::to_string(sent->activity), "the request", 0}});
  if (!answer.ok) return fail(answer.text);
  sent_.emplace(answer.id, Sent{sent->module, sent->module + "::Abort#" + std::to_string(answer.id), {}, -1, {}});
  while (!sent_.at(answer.id).final) receive(Duration::max());
  const std::string report = sent_.at(answer.id).final->report;
  sent_.erase(answer.id);
  // It may have ended by itself meanwhile.
  return report == "ok" || report == "ACTIVITY_ALREADY_ENDED" || report == "UNKNOWN_ACTIVITY"
             ? succeed("")
             : fail(sent->name + ": " + report, "REPORT");
}

int TaskInterpreter::state(Words words) {
  if (words.size() != 2) return usage(words, "request");
  std::uint32_t id = 0;
  const Sent* const sent = find_sent(words[1], id);
  if (sent == nullptr) return TCL_ERROR;
  while (receive(Duration())) {
  }
  if (sent->final) return succeed("ended");
  return succeed(sent->activity < 0 ? "sent" : "running");
}

}  // namespace waitpoint::tcl
