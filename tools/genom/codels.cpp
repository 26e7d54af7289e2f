// SPDX-License-Identifier: BSD-3-Clause
// Files that belong to the user once they are written: codels, scenario, Makefile.
#include <fmt/format.h>

#include "tools/genom/c_text.hpp"
#include "tools/genom/generators.hpp"

namespace waitpoint::tools {

using description::Description;

namespace {

std::string stubs(const Description& description, const std::string& title, const std::vector<Codel>& codels) {
  std::string text = fmt::format("/* {} */\n#include \"{}Header.h\"\n", title, description.name.text);
  for (const Codel& codel : codels)
    text += fmt::format("\n/* {} */\n{} {{\n{}{}  return {};\n}}\n", codel.comment, codel.prototype, codel.parameters,
                        codel.prototype.ends_with("(void)") ? "" : "  (void)report;\n", codel.returned);
  return text;
}

}  // namespace

std::string control_stubs(const Description& description) {
  return stubs(description, fmt::format("The control codels of {}.", description.name.text),
               control_codels(description));
}

std::string task_stubs(const Description& description, std::size_t task) {
  return stubs(
      description,
      fmt::format("The codels of {}'s execution task {}.", description.name.text, description.tasks[task].name.text),
      task_codels(description, task));
}

std::string scenario(const Description& description) {
  const std::string& module = description.name.text;
  std::string text = fmt::format(
      "# A robot with the module {0} alone.\nformat: 1\nname: {0}\nuntil_s: 60\n\nrobots:\n  - name: robot\n"
      "    shape: {{radius_m: 0.2, height_m: 0.5}}\n    start: [0, 0, 0]\n    modules:\n      - name: {0}\n",
      module);
  // GenoM's priorities count from 0, the most urgent; they matter to tasks that share a processor.
  if (!description.tasks.empty()) text += "        tasks:\n";
  for (const description::ExecTask& task : description.tasks)
    text += fmt::format("          {}: {{priority: {}}}\n", task.name.text, 255 - task.priority);
  return text;
}

std::string makefile(const Description& description, const std::vector<std::string>& include_folders) {
  std::string includes, packages;
  for (const std::string& folder : include_folders) includes += " -I" + folder;
  for (const std::string& package : description.packages) packages += " " + package;
  return fmt::format(
      "# Builds the program {0}: make. For the threads of the system: make WAITPOINT=waitpoint-robots-native "
      "OBJECTS=native\n"
      "WAITPOINT = waitpoint-robots\n"
      "PACKAGES ={1}\n"
      "# Folders of other generated modules that belong to the program, whose types MAIN then has to list.\n"
      "MODULES =\n"
      "MAIN = server/{0}Main.cpp\n"
      "INCLUDES = -Iserver{2} $(MODULES:%=-I%/server) $(MODULES:%=-I%)\n"
      "CFLAGS = -O2 -g -Wall -Wextra\n"
      "CXXFLAGS = -O2 -g -Wall -Wextra\n"
      "OBJECTS = objects\n\n"
      "FLAGS := $(INCLUDES) $(shell pkg-config --cflags $(WAITPOINT) $(PACKAGES))\n"
      "LIBRARIES := $(shell pkg-config --libs $(WAITPOINT) $(PACKAGES))\n"
      "FOUND := $(foreach folder,. $(MODULES),$(wildcard $(addprefix $(folder)/,codels/*.c codels/*.cc codels/*.cpp "
      "server/*.cpp)))\n"
      "SOURCES := $(filter-out %Main.cpp,$(FOUND)) $(MAIN)\n"
      "BUILT := $(patsubst %,$(OBJECTS)%.o,$(abspath $(SOURCES)))\n\n"
      "{0}: $(BUILT)\n\t$(CXX) $(BUILT) -o $@ $(LIBRARIES) $(LDFLAGS)\n\n"
      "$(OBJECTS)/%.c.o: /%.c $(wildcard server/*.h)\n\t@mkdir -p $(@D)\n\t$(CC) $(CFLAGS) $(FLAGS) -c $< -o $@\n\n"
      "$(OBJECTS)/%.o: /% $(wildcard server/*.h*)\n\t@mkdir -p $(@D)\n\t$(CXX) -std=c++20 $(CXXFLAGS) $(FLAGS) -c $< "
      "-o "
      "$@\n\n"
      "clean:\n\trm -rf {0} $(OBJECTS)\n.PHONY: clean\n",
      description.name.text, packages, includes);
}

}  // namespace waitpoint::tools
