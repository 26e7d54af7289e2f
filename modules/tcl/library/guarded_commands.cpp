// SPDX-License-Identifier: BSD-3-Clause
#include "modules/tcl/library/guarded_commands.hpp"

#include <algorithm>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace waitpoint::tcl {
namespace {

namespace fs = std::filesystem;

using Words = std::span<Tcl_Obj* const>;

// In the kernel's file systems, files that look regular have contents of the machine and the process.
bool is_kernels(const std::string& path) {
  return path.starts_with("/proc/") || path.starts_with("/sys/") || path.starts_with("/dev/");
}

bool may_be_opened(Tcl_Obj* name) {
  if (Tcl_GetString(name)[0] == '|') return false;
  const auto* const native = static_cast<const char*>(Tcl_FSGetNativePath(name));
  std::error_code error;
  if (native == nullptr || !fs::exists(native, error)) return true;
  const fs::file_status status = fs::status(native, error);
  if (fs::is_directory(status)) return true;
  return fs::is_regular_file(status) && !is_kernels(fs::canonical(native, error).string());
}

// Of `open`, the name is the first argument; of `source` and of commands that copy, it is one of several.
bool first_may_be_opened(Words words) { return words.size() < 2 || may_be_opened(words[1]); }
bool all_may_be_opened(Words words) { return std::all_of(words.begin() + 1, words.end(), may_be_opened); }

// `create` may be abbreviated.
bool makes_no_interpreter(Words words) {
  return words.size() < 2 || !std::string_view(Tcl_GetString(words[1])).starts_with("cr");
}

bool any(Words) { return true; }

// A folder's entries come in the order of its file system.
void sort_result(Tcl_Interp* tcl) {
  int count = 0;
  Tcl_Obj** names = nullptr;
  if (Tcl_ListObjGetElements(tcl, Tcl_GetObjResult(tcl), &count, &names) != TCL_OK) return;
  std::vector<Tcl_Obj*> sorted(names, names + count);
  std::sort(sorted.begin(), sorted.end(), [](Tcl_Obj* a, Tcl_Obj* b) {
    return std::string_view(Tcl_GetString(a)) < std::string_view(Tcl_GetString(b));
  });
  Tcl_SetObjResult(tcl, Tcl_NewListObj(count, sorted.data()));
}

void keep_result(Tcl_Interp*) {}

struct Guard {
  const char* command;
  bool (*allows)(Words words);
  const char* refusal;
  void (*finish)(Tcl_Interp* tcl);
};

constexpr const char* no_file = "a script in virtual time reads and writes regular files only";
constexpr Guard guards[] = {
    {"::open", first_may_be_opened, no_file, keep_result},
    {"::source", all_may_be_opened, no_file, keep_result},
    {"::tcl::file::copy", all_may_be_opened, no_file, keep_result},
    {"::interp", makes_no_interpreter, "a script in virtual time makes no further interpreters", keep_result},
    {"::glob", any, "", sort_result},
};

struct Guarded {
  const Guard& guard;
  Tcl_CmdInfo original;
};

int call_guarded(ClientData data, Tcl_Interp* tcl, int count, Tcl_Obj* const* words) {
  const auto& guarded = *static_cast<const Guarded*>(data);
  if (!guarded.guard.allows({words, static_cast<std::size_t>(count)})) {
    Tcl_SetObjResult(tcl, Tcl_NewStringObj(guarded.guard.refusal, -1));
    return TCL_ERROR;
  }
  const int result = guarded.original.objProc(guarded.original.objClientData, tcl, count, words);
  if (result == TCL_OK) guarded.guard.finish(tcl);
  return result;
}

// timerate would count without end: time stands still within commands. `representation` has addresses.
constexpr const char* deletions = R"(
  apply {{} {
    foreach name {exec socket fileevent pid load unload cd pwd} { rename ::$name {} }
    foreach name {timerate representation} {
      foreach command [list ::$name ::tcl::unsupported::$name] {
        if {[llength [info commands $command]]} { rename $command {} }
      }
    }
    foreach {ensemble names} {
      file {atime mtime stat lstat attributes owned tempfile system volumes}
      info {hostname loaded}
      chan {event pipe}
    } {
      set map [namespace ensemble configure ::$ensemble -map]
      foreach name $names {
        dict unset map $name
        rename ::tcl::${ensemble}::$name {}
      }
      if {$ensemble eq "chan"} { dict set map puts ::puts }
      namespace ensemble configure ::$ensemble -map $map
    }
    rename ::tcl::chan::puts {}
  }}
  unset -nocomplain ::tcl_platform(machine) ::tcl_platform(osVersion) ::tcl_platform(user)
)";

}  // namespace

void guard_commands(Tcl_Interp* tcl) {
  Tcl_Eval(tcl, deletions);
  for (const Guard& guard : guards) {
    Tcl_CmdInfo original{};
    Tcl_GetCommandInfo(tcl, guard.command, &original);
    Tcl_CreateObjCommand(tcl, guard.command, call_guarded, new Guarded{guard, original},
                         [](ClientData data) { delete static_cast<Guarded*>(data); });
  }
}

}  // namespace waitpoint::tcl
