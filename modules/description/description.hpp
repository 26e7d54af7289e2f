// SPDX-License-Identifier: BSD-3-Clause
// A module as its GenoM description (FILE.gen) declares it, with all names resolved: the types of inputs, outputs and
// posters, and the tasks and requests that others name.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "modules/description/type.hpp"

namespace waitpoint::description {

/// A name, and where it stands.
struct Name {
  std::string text;
  SourcePlace place;
};

/// `name::path`: a member of the internal data, by a name of its own; of a poster's `type`, without a path.
struct Parameter {
  std::string name;
  std::vector<std::string> path;
  TypeRef type;  ///< null until resolved
  SourcePlace place;

  bool operator==(const Parameter& other) const { return name == other.name && path == other.path; }
};

/// `default::"text"`: of one number or text of an input.
struct InputInfo {
  std::string value;  ///< as C writes it
  bool is_text = false;
  std::string text;
  SourcePlace place;
};

enum class RequestKind : std::uint8_t { control, exec, init };
const char* name(RequestKind kind);

struct Request {
  Name name;
  std::string doc;
  RequestKind kind = RequestKind::control;
  std::optional<Name> exec_task;  ///< of exec and init requests
  std::optional<Parameter> input, output;
  std::vector<InputInfo> input_infos;
  std::string control, start, main, end, fail, inter;  ///< codels; "": none
  std::vector<Name> fail_reports;
  std::vector<Name> interrupts;  ///< requests whose activities it interrupts; `all` is resolved
  std::vector<std::string> posters_input;
};

struct Poster {
  Name name;
  bool automatic = false;       ///< update: auto
  std::vector<Parameter> data;  ///< its fields
  Name exec_task;
};

struct ExecTask {
  Name name;
  std::optional<std::int64_t> period_ticks;  ///< nothing: woken by events
  std::int64_t delay_ticks = 0;
  std::int64_t priority = 0;  ///< 0 is the most urgent, 255 the least
  std::int64_t stack_size = 0;
  std::string start, main, main2, end, wait;  ///< codels; "": none
  std::vector<Name> fail_reports;
  std::vector<std::string> posters_input;
  std::vector<std::string> reads;         ///< poster_client_from: "module.poster"
  std::vector<std::string> clients_from;  ///< cs_client_from: modules to which it sends requests
};

struct Description {
  std::string file;
  Name name;  ///< of the module
  std::int64_t number = 0;
  std::int64_t ticks_per_s = 100;
  std::string version, email;
  bool cxx_codels = false;                ///< lang: "c++"
  std::vector<std::string> packages;      ///< of `requires` and `codels_requires`, for pkg-config
  TypeRef data;                           ///< internal_data, a struct
  std::vector<std::string> declarations;  ///< the C text of the file itself: includes, constants, types, in order
  std::vector<std::string> imports;       ///< modules of `import from`
  std::vector<Request> requests;
  std::vector<Poster> posters;
  std::vector<ExecTask> tasks;
  std::vector<std::string> reports;  ///< all fail_reports, by their order in the file, once each
};

const ExecTask* find_task(const Description& description, const std::string& name);

/// "MODULE_POSTER_POSTER_STR": the C type of a poster.
std::string poster_type_name(const Description& description, const Poster& poster);

/// The type of a poster's value: a struct of its data.
TypeRef poster_type(const Description& description, const Poster& poster);

/// "state.position"
std::string path_text(const Parameter& parameter);

}  // namespace waitpoint::description
