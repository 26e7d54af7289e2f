// SPDX-License-Identifier: BSD-3-Clause
#include "modules/tcl/module_link.hpp"

#include <utility>

#include "core/file_list.hpp"
#include "core/nearest_name.hpp"
#include "core/printable_line.hpp"

namespace waitpoint::tcl {
namespace {

constexpr std::uint64_t by_a_script = 0x74636C;  // "tcl"

}  // namespace

std::string text_of(genom::Report report) {
  const std::string text = genom::name(report);
  return text == "own report" ? text + " " + std::to_string(genom::code_of(report)) : text;
}

ModuleLink::ModuleLink(genom::NameSpace& names, std::string robot, const std::string& owner,
                       std::function<void(Time date, const std::string& line)> say, std::vector<std::string> folders)
    : names_(names),
      robot_(std::move(robot)),
      client_(names, owner),
      say_(std::move(say)),
      folders_(std::move(folders)) {}

bool ModuleLink::takes_file(const std::string& file, bool writes) {
  try {
    FileList::add(file, writes ? FileRole::written : FileRole::read);
  } catch (const BadInput&) {
    return false;
  }
  return true;
}

std::vector<std::string> ModuleLink::modules() const {
  std::vector<std::string> all;
  for (const auto& [name, module] : names_.modules()) all.push_back(name);
  return all;
}

std::vector<RequestShape> ModuleLink::requests(const std::string& module) const {
  std::vector<RequestShape> all;
  for (const genom::RequestType& type : names_.find_module(module)->requests())
    all.push_back({type.name, type.input_shape()});
  return all;
}

Answer ModuleLink::send(const std::string& module, const std::string& request, const std::vector<Setting>& input) {
  try {
    genom::Settings arguments(input);
    const genom::Payload payload = names_.find_module(module)->find_request(request)->read_input(arguments);
    const std::optional<std::uint32_t> id = client_.send(module, request, payload);
    if (!id) return {false, module + "::" + request + ": the module's mailbox is full"};
    return {true, "", *id};
  } catch (const BadInput& error) {
    return {false, module + "::" + request + ": " + error.what()};
  }
}

std::optional<ReplyText> ModuleLink::receive(Duration timeout) {
  const std::optional<genom::Reply> reply = client_.receive(timeout);
  if (!reply) return std::nullopt;
  return ReplyText{reply->send_id,         reply->final,        reply->activity, reply->report == genom::ok,
                   text_of(reply->report), reply->output.text()};
}

Answer ModuleLink::read_poster(const std::string& module, const std::string& name) {
  const genom::PosterBase* const poster = names_.find_poster(module + "." + name);
  if (poster == nullptr) {
    std::vector<std::string_view> known;
    for (const auto& [other, entry] : names_.posters())
      if (other.starts_with(module + ".")) known.push_back(std::string_view(other).substr(module.size() + 1));
    return {false, "there is no poster '" + module + "." + name + "'" + did_you_mean(name, known)};
  }
  const std::optional<std::string> text = poster->read_text();
  return text ? Answer{true, *text} : Answer{false, "the poster '" + module + "." + name + "' is empty"};
}

void ModuleLink::sleep_until(Time time) {
  if (time > threads::now()) threads::this_thread::sleep_for(std::chrono::nanoseconds((time - threads::now()).ns()));
}

void ModuleLink::say(const std::string& line) {
  const std::string printable = printable_line(line);
  Digest digest;
  digest.add(std::string_view(printable));
  threads::record(by_a_script, digest.value());
  say_(threads::now(), printable);
}

}  // namespace waitpoint::tcl
