// SPDX-License-Identifier: BSD-3-Clause
#include "tools/main.hpp"

int main(int argc, char** argv) { return waitpoint::main(argc, argv); }
