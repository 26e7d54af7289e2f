// SPDX-License-Identifier: BSD-3-Clause
//
// The process of several programs. Its main() is never called: the preloaded library loads the programs that its
// arguments name instead.

int main() { return 1; }
