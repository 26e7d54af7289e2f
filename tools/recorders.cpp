// SPDX-License-Identifier: BSD-3-Clause
#include "tools/recorders.hpp"

namespace waitpoint::tools {

void DigestRecorder::record(const Simulation& simulation, std::int64_t second) {
  for (const kernel::Robot* robot = simulation.scheduler().first_robot(); robot != nullptr; robot = robot->next) {
    char line[160];
    const int length =
        std::snprintf(line, sizeof line, "%lld %s %s %llu\n", static_cast<long long>(second), robot->name,
                      to_string(robot->digest).c_str(), static_cast<unsigned long long>(robot->events));
    file_.write({line, static_cast<std::size_t>(length)});
  }
}

EventRecorder::EventRecorder(const std::filesystem::path& path) : Watch{&EventRecorder::write}, file_(path) {
  file_.write("# time robot task operation object\n");
}

void EventRecorder::write(kernel::Watch& watch, const kernel::EventRecord& record) {
  char line[320];
  const long long ns = record.time.ns();
  int length = std::snprintf(line, sizeof line, "%lld.%09lld %s %s %s", ns / 1'000'000'000, ns % 1'000'000'000,
                             record.task->robot->name, record.task->name, kernel::name(record.operation));
  if (const kernel::Object* object = record.object; object != nullptr) {
    length += std::snprintf(line + length, sizeof line - static_cast<std::size_t>(length), " %s#%u", object->kind,
                            object->number);
    if (object->label[0] != '\0')
      length += std::snprintf(line + length, sizeof line - static_cast<std::size_t>(length), " \"%s\"", object->label);
  }
  line[length++] = '\n';
  static_cast<EventRecorder&>(watch).file_.write({line, static_cast<std::size_t>(length)});
}

}  // namespace waitpoint::tools
