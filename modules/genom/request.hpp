// SPDX-License-Identifier: BSD-3-Clause
// Request types: the calls that a module accepts, with the functions (codels) that carry them out.
//
// A control request is executed at once and has one reply. An execution request becomes an activity of an execution
// task, with an intermediate reply at its start and a final one at its end. Codels have typed input and output.
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

/// A request type as the frame handles it, without the types of its input and output.
struct RequestType {
  std::string name;
  RequestKind kind = RequestKind::control;
  std::uint32_t number = 0;
  ExecutionTask* task = nullptr;        ///< of execution requests; null for control requests
  std::vector<std::string> interrupts;  ///< request types whose activities a new activity of this type interrupts
  Duration cost;                        ///< of each codel call
  bool (*accepts)(const Payload& input) = nullptr;
  /// Parses the input by its declared fields; unset fields keep their defaults. BadInput for unknown keys or bad
  /// values.
  Payload (*read_input)(Settings& arguments) = nullptr;
  /// True if the input has a number at this path: core/field_path.hpp.
  bool (*has_input)(std::string_view path) = nullptr;
  FieldShape (*input_shape)() = nullptr;
  std::function<Report(const Payload& input, Payload& output)> control;
  /// Calls the codel of that state; nothing if there is none.
  std::function<std::optional<State>(State state, Activity& activity)> codel;
};

/// An activity as seen by its codels.
template <HasFields In, HasFields Out>
struct Running {
  const In input;
  Out output{};
  Report report = ok;        ///< for the final reply: ok or one of the module's own reports
  std::int32_t number = -1;  ///< of the activity
};

/// The codels of an execution request; all but `exec` are usually omitted.
template <HasFields In, HasFields Out = Nothing>
struct Codels {
  using Codel = std::function<State(Running<In, Out>& activity)>;
  std::function<Report(const In& input)> control = nullptr;  ///< checks the input; not ok: the request is rejected
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

template <class In>
bool has_input(std::string_view path) {
  double ignored = 0;
  return read_number(In{}, path, ignored) != FieldOutcome::unknown;
}

template <class In>
FieldShape input_shape() {
  return shape_of<In>();
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
