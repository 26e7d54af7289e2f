// SPDX-License-Identifier: BSD-3-Clause
//
// The process of several programs. It is nothing but a place: the library that is preloaded into it does not come to
// its main(), but loads the programs that its arguments name.

int main() { return 1; }
