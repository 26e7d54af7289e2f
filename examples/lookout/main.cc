// SPDX-License-Identifier: BSD-3-Clause
// The program of the two modules.
#include <waitpoint/modules/genom/module.hpp>
#include <waitpoint/tools/main.hpp>

#include "lookoutModule.hpp"
#include "mastModule.hpp"

int main(int argc, char** argv) {
  return waitpoint::main(argc, argv, {genom_lookout::module_type(), genom_mast::module_type()});
}
