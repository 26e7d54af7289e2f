// SPDX-License-Identifier: BSD-3-Clause
// The client library.
#include <fmt/format.h>

#include "tools/genom/c_text.hpp"
#include "tools/genom/generators.hpp"

namespace waitpoint::tools {

using description::Description;
using description::Parameter;
using description::Poster;
using description::Request;
using description::RequestKind;
using description::TypeKind;

namespace {

// The value behind a pointer of C's.
std::string value_of(const Parameter& parameter) {
  if (parameter.type->kind != TypeKind::array) return "*" + parameter.name;
  return fmt::format("*reinterpret_cast<{}>({})", c_declaration(*parameter.type, "(*)"), parameter.name);
}

std::string send_function(const Request& request, const std::string& name) {
  std::string pack = "  const Nothing in_{};\n";
  if (request.input)
    pack = fmt::format("  {}Input in_;\n  from_c(in_.{}, {});\n", request.name.text, request.input->name,
                       value_of(*request.input));
  return fmt::format(
      "STATUS {}RqstSend(CLIENT_ID client, int *rqstId, {}int) {{\n{}"
      "  return reinterpret_cast<CClient*>(client)->send(\"{}\", Payload(in_), rqstId);\n}}\n",
      name, input_parameter(request), pack, request.name.text);
}

// A function of the file that all receiving functions call: it waits for at most so many ticks (0: without limit).
std::string receive_function(const Request& request, std::int64_t ticks_per_s) {
  const std::string type = request.output ? request.name.text + "Output" : "Nothing";
  const std::string unpack =
      request.output ? fmt::format("  to_c({}, out_.{});\n", value_of(*request.output), request.output->name) : "";
  return fmt::format(
      "static int receive_{0}(CLIENT_ID client, int rqstId, int block, int ticks_, {1}int *activity, int *report) {{\n"
      "  {2} out_;\n  const auto timeout_ = ticks_ > 0 ? Duration(std::chrono::nanoseconds({3}LL * ticks_)) : "
      "Duration::max();\n"
      "  const int status_ = reinterpret_cast<CClient*>(client)->receive(rqstId, block, &out_, activity, report, "
      "timeout_);\n"
      "{4}  return status_;\n}}\n",
      request.name.text, output_parameter(request), type, 1'000'000'000 / ticks_per_s,
      request.output ? fmt::format("  if (status_ == FINAL_REPLY_OK) {{\n  {}  }}\n", unpack) : "");
}

std::string control_functions(const Request& request, const std::string& name) {
  return fmt::format(
      "int {0}ReplyRcv(CLIENT_ID client, int rqstId, int block, {1}int *report) {{\n  int activity = -1;\n"
      "  return receive_{2}(client, rqstId, block, 0, {3}&activity, report);\n}}\n"
      "int {0}RqstAndRcv(CLIENT_ID client, {4}{1}int *report) {{\n  int rqstId = -1;\n"
      "  if ({0}RqstSend(client, &rqstId, {5}0) != OK) return ERROR;\n"
      "  return {0}ReplyRcv(client, rqstId, BLOCK_ON_FINAL_REPLY, {3}report);\n}}\n",
      name, output_parameter(request), request.name.text, output_name(request), input_parameter(request),
      input_name(request));
}

std::string execution_functions(const Request& request, const std::string& name) {
  return fmt::format(
      "int {0}ReplyRcv(CLIENT_ID client, int rqstId, int block, {1}int *activity, int *report) {{\n"
      "  return receive_{2}(client, rqstId, block, 0, {3}activity, report);\n}}\n"
      "int {0}RqstAndAck(CLIENT_ID client, int *rqstId, int replyTimeOut, {4}{1}int *activity, int *report) {{\n"
      "  if ({0}RqstSend(client, rqstId, {5}replyTimeOut) != OK) return ERROR;\n"
      "  return receive_{2}(client, *rqstId, BLOCK_ON_INTERMED_REPLY, replyTimeOut, {3}activity, report);\n}}\n"
      "int {0}RqstAndRcv(CLIENT_ID client, int replyTimeOut, {4}{1}int *activity, int *report) {{\n  int rqstId = -1;\n"
      "  if ({0}RqstSend(client, &rqstId, {5}replyTimeOut) != OK) return ERROR;\n"
      "  return receive_{2}(client, rqstId, BLOCK_ON_FINAL_REPLY, replyTimeOut, {3}activity, report);\n}}\n",
      name, output_parameter(request), request.name.text, output_name(request), input_parameter(request),
      input_name(request));
}

}  // namespace

std::string client_source(const Description& description) {
  const std::string& module = description.name.text;
  std::string text = generated_line(description, "//");
  text += fmt::format(
      "#include \"{0}MsgLib.h\"\n\n#include <waitpoint/modules/genom/c_module.hpp>\n\n#include \"{0}Fields.hpp\"\n\n"
      "using namespace genom_{0};\nusing waitpoint::Duration;\nusing waitpoint::genom::AbortInput;\n"
      "using waitpoint::genom::CClient;\nusing waitpoint::genom::CModule;\nusing waitpoint::genom::from_c;\n"
      "using waitpoint::genom::Nothing;\nusing waitpoint::genom::Payload;\nusing waitpoint::genom::PosterBase;\n"
      "using waitpoint::genom::to_c;\n\n"
      "STATUS {0}ClientInit(CLIENT_ID *client) {{\n  *client = "
      "reinterpret_cast<CLIENT_ID>(CModule::running().client(\"{0}\"));\n"
      "  return *client != nullptr ? OK : ERROR;\n}}\n"
      "STATUS {0}ClientEnd(CLIENT_ID) {{ return OK; }}\n\n"
      "int {0}AbortRqstAndRcv(CLIENT_ID client, int *activity, int *report) {{\n  int rqstId = -1, none = -1;\n"
      "  CClient& of = *reinterpret_cast<CClient*>(client);\n"
      "  if (of.send(\"Abort\", Payload(AbortInput{{*activity}}), &rqstId) != OK) return ERROR;\n"
      "  return of.receive<Nothing>(rqstId, BLOCK_ON_FINAL_REPLY, nullptr, &none, report);\n}}\n",
      module);
  for (const Request& request : description.requests) {
    const std::string name = module + request.name.text;
    text += "\n" + send_function(request, name) + receive_function(request, description.ticks_per_s);
    text +=
        request.kind == RequestKind::control ? control_functions(request, name) : execution_functions(request, name);
  }
  for (const Poster& poster : description.posters)
    text += fmt::format(
        "\nSTATUS {0}{1}PosterFind(POSTER_ID *poster) {{\n  *poster = CModule::running().find_poster(\"{0}.{1}\");\n"
        "  return *poster != nullptr ? OK : ERROR;\n}}\n"
        "STATUS {0}{1}PosterRead(POSTER_ID poster, {2} *value) {{\n"
        "  return static_cast<PosterBase*>(poster)->read_c(value, sizeof *value) ? OK : ERROR;\n}}\n",
        module, poster.name.text, poster_type_name(description, poster));
  return text;
}

}  // namespace waitpoint::tools
