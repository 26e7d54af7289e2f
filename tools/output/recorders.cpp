// SPDX-License-Identifier: BSD-3-Clause
#include "tools/output/recorders.hpp"

#include "fibers/kernel/run.hpp"

namespace waitpoint::tools {

void DigestRecorder::record(const Simulation& simulation, std::int64_t second) {
  for (const kernel::Robot* robot = kernel::roster(simulation.scheduler()).first_robot(); robot != nullptr;
       robot = robot->next) {
    char line[160];
    const int length = std::snprintf(line, sizeof line, "%lld %s %s %llu\n", static_cast<long long>(second),
                                     robot->name, to_string(robot->digest.digest()).c_str(),
                                     static_cast<unsigned long long>(robot->digest.pairs()));
    file_.write({line, static_cast<std::size_t>(length)});
  }
}

void DigestRecorder::cut_off(const std::string& reason) {
  file_.write("# cut off: " + reason + "\n");
  finish();
}

EventRecorder::EventRecorder(const std::filesystem::path& path) : Watch{&EventRecorder::write}, file_(path) {
  file_.write("# time robot task operation object\n");
}

std::string event_text(const kernel::EventRecord& record) {
  std::string line = to_string(record.time);
  line += std::string(" ") + record.task->robot->name + " " + record.task->name + " " + kernel::name(record.operation);
  if (const kernel::Object* object = record.object; object != nullptr) {
    line += std::string(" ") + object->kind + "#" + std::to_string(object->number);
    if (object->label[0] != '\0') line += std::string(" \"") + object->label + "\"";
  }
  return line;
}

void EventRecorder::write(kernel::Watch& watch, const kernel::EventRecord& record) {
  static_cast<EventRecorder&>(watch).file_.write(event_text(record) + "\n");
}

void EventRecorder::cut_off(const std::string& reason) {
  file_.write("# cut off: " + reason + "\n");
  finish();
}

}  // namespace waitpoint::tools
