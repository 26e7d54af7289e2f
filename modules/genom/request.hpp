// SPDX-License-Identifier: BSD-3-Clause
// Request types: what a module can be asked, with the functions (codels) that do it.
//
// A control request takes no time and has one reply. An execution request becomes an activity of an execution task: an
// intermediate reply when it starts, a final one when it ends. Codels see their input and write their output by type.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/time.hpp"
#include "modules/genom/activity.hpp"
#include "modules/genom/settings.hpp"

namespace waitpoint::genom {

class ExecutionTask;

enum class RequestKind : std::uint8_t { control, execution, init };

/// A request type as the frame handles it, whatever the types of its input and output.
struct RequestType {
  std::string name;
  RequestKind kind = RequestKind::control;
  std::uint32_t number = 0;
  ExecutionTask* task = nullptr;        ///< of execution requests
  std::vector<std::string> interrupts;  ///< request types whose activities a new one of this type ends
  Duration cost;                        ///< of one call of a codel of this request
  bool (*accepts)(const Payload& input) = nullptr;
  /// The input from text, by its declared fields; what is not set keeps its default. BadInput for what does not fit.
  Payload (*read_input)(Settings& arguments) = nullptr;
  std::function<Report(const Payload& input, Payload& output)> control;
  /// Calls the codel of that state; nothing if none is given.
  std::function<std::optional<State>(State state, Activity& activity)> codel;
};

/// An activity as its codels see it.
template <HasFields In, HasFields Out>
struct Running {
  const In input;
  Out output{};
  Report report = ok;        ///< what the final reply says; of the module's own reports
  std::int32_t number = -1;  ///< of the activity
};

/// The codels of an execution request; any but `exec` is often left out.
template <HasFields In, HasFields Out = Nothing>
struct Codels {
  using Codel = std::function<State(Running<In, Out>& activity)>;
  std::function<Report(const In& input)> control = nullptr;  ///< may refuse the request before anything happens
  Codel start = nullptr, exec = nullptr, end = nullptr, fail = nullptr, inter = nullptr;
};

namespace internal {

template <class In>
bool accepts(const Payload& input) {
  return input.holds<In>();
}

template <class In>
Payload read_input(Settings& arguments) {
  In input{};
  arguments.read(input);
  arguments.check_all_used();
  return Payload(input);
}

template <class In, class Out>
std::optional<State> call_codel(const Codels<In, Out>& codels, State state, Activity& activity) {
  const typename Codels<In, Out>::Codel* codel = nullptr;
  switch (state) {
    case State::start: codel = &codels.start; break;
    case State::exec: codel = &codels.exec; break;
    case State::end: codel = &codels.end; break;
    case State::fail: codel = &codels.fail; break;
    case State::inter: codel = &codels.inter; break;
    default: break;
  }
  if (codel == nullptr || *codel == nullptr) return std::nullopt;
  Running<In, Out> running{activity.input.as<In>(), activity.output.holds<Out>() ? activity.output.as<Out>() : Out{},
                           activity.report, activity.number};
  const State next = (*codel)(running);
  activity.output = Payload(running.output);
  activity.report = running.report;
  return next;
}

}  // namespace internal
}  // namespace waitpoint::genom
