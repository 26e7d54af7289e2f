// SPDX-License-Identifier: BSD-3-Clause
//
// Counters of two libraries, of which one is linked to the other, and of the programs that are linked to them.
#pragma once

inline int of_all = 0;  // one variable, of the program and its libraries; the compiler marks it unique per process

template <class T>
struct Kept {
  static int value;
};
template <class T>
int Kept<T>::value = 0;

extern int of_lower;         // a variable of the lower library
int count_in_lower();        // counts it, a variable of the thread, and those above; returns the thread's
int chosen_when_loaded();    // 7, by a function that is chosen when the library is loaded
int count_in_upper();        // the same for the upper library's, and in the lower one; returns the upper library's own
void note(const char* who);  // adds to the order in which constructors were called
const char* order();
