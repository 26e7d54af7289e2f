// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <map>
#include <set>

#include "core/nearest_name.hpp"
#include "modules/description/parser.hpp"

namespace waitpoint::description {
namespace {

// The frame's limits: modules/genom/payload.hpp, GenoM's own number of posters.
constexpr std::size_t payload_bytes_max = 1024;

class Resolution {
 public:
  explicit Resolution(Description& description) : description_(description) {}

  void run() {
    check_names();
    for (Request& request : description_.requests) resolve(request);
    for (Poster& poster : description_.posters) resolve(poster);
    for (const ExecTask& task : description_.tasks) check(task);
  }

 private:
  void check_names() const {
    std::set<std::string> seen = {"Abort"};  // of every module
    for (const Request& request : description_.requests) add(seen, request.name, "requests");
    seen = {"control"};
    for (const Poster& poster : description_.posters) add(seen, poster.name, "posters");
    seen = {"control"};
    for (const ExecTask& task : description_.tasks) add(seen, task.name, "exec_tasks");
  }
  static void add(std::set<std::string>& seen, const Name& name, const char* what) {
    if (!seen.insert(name.text).second)
      reject(name.place, std::string("expected ") + what + " of different names, found '" + name.text + "' again");
  }

  void check_task(const Name& named) const {
    if (find_task(description_, named.text) != nullptr) return;
    std::vector<std::string_view> known;
    for (const ExecTask& task : description_.tasks) known.push_back(task.name.text);
    reject(named.place,
           "expected an exec_task of this module, found '" + named.text + "'" + did_you_mean(named.text, known));
  }

  void resolve_member(Parameter& parameter) const {
    if (parameter.type != nullptr) return;
    TypeRef type = description_.data;
    if (parameter.path != std::vector<std::string>{"all"}) {
      for (const std::string& step : parameter.path) {
        const Field* field = find_field(*type, step);
        if (field == nullptr) unknown_member(parameter, *type, step);
        type = field->type;
      }
    }
    parameter.type = type;
    while (type->name.empty() && type->kind == TypeKind::array) type = type->element;
    if (type->name.empty())
      reject(parameter.place, "expected a member whose type has a name, found '" + path_text(parameter) + "'");
  }
  static void unknown_member(const Parameter& parameter, const Type& type, const std::string& step) {
    std::vector<std::string_view> known;
    for (const Field& field : type.fields) known.push_back(field.name);
    reject(parameter.place, "expected a member of " + (type.name.empty() ? "a struct" : type.name) + ", found '" +
                                step + "' in '" + parameter.name + "::" + path_text(parameter) + "'" +
                                did_you_mean(step, known));
  }
  void resolve_letter(std::optional<Parameter>& parameter) const {
    if (!parameter) return;
    // Names of the other parameters of codels and client functions.
    for (const char* taken : {"client", "rqstId", "replyTimeOut", "block", "activity", "report"})
      if (parameter->name == taken) reject(parameter->place, "expected another name than '" + parameter->name + "'");
    resolve_member(*parameter);
    if (frame_size(*parameter->type) > payload_bytes_max)
      reject(parameter->place, "expected an input or output of at most 1024 bytes, found " +
                                   std::to_string(frame_size(*parameter->type)) + " (larger values are for posters)");
  }
  // A bound: the frame carries float as double.
  static std::size_t frame_size(const Type& type) {
    if (type.kind == TypeKind::array) return type.count * frame_size(*type.element);
    if (type.kind != TypeKind::structure) return type.size == 4 ? 8 : type.size;
    std::size_t size = 0;
    for (const Field& field : type.fields) size += std::max(frame_size(*field.type), type.alignment);
    return size;
  }

  void resolve(Request& request) {
    resolve_letter(request.input);
    resolve_letter(request.output);
    check_codels(request);
    add_signatures(request);
    resolve_interrupts(request);
    add_reports(request.fail_reports);
    if (request.kind == RequestKind::init && std::count_if(description_.requests.begin(), description_.requests.end(),
                                                           [](auto& r) { return r.kind == RequestKind::init; }) > 1)
      reject(request.name.place, "expected at most one request of type init");
    if (request.input_infos.empty()) return;
    const std::size_t leaves = request.input ? count_leaves(*request.input->type) : 0;
    if (request.input_infos.size() != leaves)
      reject(request.input_infos.back().place, "expected input_info for each of the " + std::to_string(leaves) +
                                                   " numbers and texts of the input, found " +
                                                   std::to_string(request.input_infos.size()));
  }

  static std::size_t count_leaves(const Type& type) {
    if (is_text(type)) return 1;
    if (type.kind == TypeKind::array) return type.count * count_leaves(*type.element);
    if (type.kind != TypeKind::structure) return 1;
    std::size_t leaves = 0;
    for (const Field& field : type.fields) leaves += count_leaves(*field.type);
    return leaves;
  }

  void check_codels(const Request& request) const {
    const std::string& name = request.name.text;
    const bool has_codels = !request.start.empty() || !request.main.empty() || !request.end.empty() ||
                            !request.fail.empty() || !request.inter.empty();
    if (request.kind == RequestKind::control) {
      if (request.exec_task)
        reject(request.exec_task->place, "expected no exec_task for the control request '" + name + "'");
      if (has_codels) reject(request.name.place, "expected codel_control alone for the control request '" + name + "'");
      return;
    }
    if (!request.exec_task) reject(request.name.place, "expected the attribute 'exec_task' of '" + name + "'");
    check_task(*request.exec_task);
    if (request.start.empty() && request.main.empty() && request.end.empty())
      reject(request.name.place, "expected codel_start, codel_main or codel_end of '" + name + "'");
  }

  // A codel may serve several requests whose inputs and outputs are alike.
  void add_signatures(const Request& request) {
    const std::string input = request.input ? structure(*request.input->type) + "*" : "";
    const std::string output = request.output ? structure(*request.output->type) + "*" : "";
    const auto add_signature = [&](const std::string& codel, const std::string& signature) {
      if (!codel.empty() && signatures_.emplace(codel, signature).first->second != signature)
        reject(request.name.place,
               "expected other codels than another request's with another input or output, found '" + codel + "' in '" +
                   request.name.text + "'");
    };
    const std::string of_activity = "activity " + input + output;
    add_signature(request.control, "control " + input);
    for (const std::string* codel : {&request.start, &request.main, &request.end, &request.fail, &request.inter})
      add_signature(*codel, of_activity);
  }

  void resolve_interrupts(Request& request) const {
    std::vector<Name> resolved;
    for (const Name& named : request.interrupts) {
      if (named.text == "none") continue;
      bool found = false;
      for (const Request& other : description_.requests) {
        if (named.text != "all" && named.text != other.name.text) continue;
        found = true;
        if (other.kind != RequestKind::control) resolved.push_back({other.name.text, named.place});
      }
      if (found || named.text == "all") continue;
      std::vector<std::string_view> known;
      for (const Request& other : description_.requests) known.push_back(other.name.text);
      reject(named.place,
             "expected a request of this module, found '" + named.text + "'" + did_you_mean(named.text, known));
    }
    if (request.kind == RequestKind::init && !resolved.empty())
      reject(request.name.place, "expected no interrupt_activity for the init request '" + request.name.text + "'");
    request.interrupts = std::move(resolved);
  }

  void add_reports(const std::vector<Name>& reports) {
    for (const Name& report : reports) {
      auto& all = description_.reports;
      if (report.text != "OK" && std::find(all.begin(), all.end(), report.text) == all.end())
        all.push_back(report.text);
    }
  }

  void resolve(Poster& poster) const {
    if (poster.data.empty())
      reject(poster.name.place, "expected the attribute 'data' or 'type' of the poster '" + poster.name.text + "'");
    if (poster.exec_task.text.empty())
      reject(poster.name.place, "expected the attribute 'exec_task' of the poster '" + poster.name.text + "'");
    check_task(poster.exec_task);
    std::set<std::string> seen;
    for (Parameter& item : poster.data) {
      if (poster.automatic && item.type != nullptr)
        reject(item.place, "expected 'data' for a poster with 'update: auto', found 'type'");
      resolve_member(item);
      add(seen, {item.name, item.place}, "fields");
    }
    poster_type(description_, poster);
  }

  void check(const ExecTask& task) {
    if (!task.wait.empty() && task.period_ticks)
      reject(task.name.place, "expected codel_task_wait for a task with 'period: none' alone");
    add_reports(task.fail_reports);
  }

  Description& description_;
  std::map<std::string, std::string> signatures_;  // of codels
};

}  // namespace

void resolve(Description& description) { Resolution(description).run(); }

}  // namespace waitpoint::description
