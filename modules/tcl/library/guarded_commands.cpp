// SPDX-License-Identifier: BSD-3-Clause
#include "modules/tcl/library/guarded_commands.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>
#include <span>
#include <string_view>

#include "modules/tcl/library/script_files.hpp"

namespace waitpoint::tcl {
namespace {

using Words = std::vector<Tcl_Obj*>;
/// Replaces the names among the words by paths; false if one of them may not be used.
using Guard = bool (*)(const ScriptFiles& files, Words& words);

std::string_view text(Tcl_Obj* word) { return Tcl_GetString(word); }

bool is_option(Tcl_Obj* word) { return text(word).starts_with('-'); }

bool resolve(const ScriptFiles& files, Tcl_Obj*& word, FileUse use) {
  const std::optional<std::string> path = files.find(std::string(text(word)), use);
  if (path) word = Tcl_NewStringObj(path->data(), static_cast<int>(path->size()));
  return path.has_value();
}

/// The same, of a file that is opened or written.
bool take(const ScriptFiles& files, Tcl_Obj*& word, FileUse use) {
  return files.take(std::string(text(word)), use) && resolve(files, word, use);
}

// Attributes of files.
bool read_all(const ScriptFiles& files, Words& words) {
  return std::all_of(words.begin() + 1, words.end(),
                     [&](Tcl_Obj*& word) { return is_option(word) || resolve(files, word, FileUse::read); });
}

bool write_all(const ScriptFiles& files, Words& words) {
  return std::all_of(words.begin() + 1, words.end(),
                     [&](Tcl_Obj*& word) { return is_option(word) || take(files, word, FileUse::write); });
}

// open NAME ?MODE? ?PERMISSIONS?
bool open_one(const ScriptFiles& files, Words& words) {
  if (words.size() < 2) return true;
  const bool reads = words.size() == 2 || text(words[2]) == "r" || text(words[2]) == "rb" || text(words[2]) == "RDONLY";
  return take(files, words[1], reads ? FileUse::read : FileUse::write);
}

// source ?-encoding NAME? FILE
bool read_last(const ScriptFiles& files, Words& words) {
  return words.size() < 2 || take(files, words.back(), FileUse::read);
}

bool leads_out(Tcl_Obj* pattern) {
  return text(pattern).starts_with('/') || text(pattern).starts_with('~') ||
         text(pattern).find("..") != std::string_view::npos || text(pattern).find('\\') != std::string_view::npos;
}

// glob ?OPTION ...? PATTERN ...: of the script's folder, or of the one that is given; never above it.
bool stay_below(const ScriptFiles& files, Words& words) {
  bool has_folder = false;
  auto word = words.begin() + 1;
  for (; word < words.end() && is_option(*word) && text(*word) != "--"; ++word) {
    const std::string_view option = text(*word);  // may be abbreviated
    if (option.starts_with("-p")) return false;   // -path: the beginning of names
    if (!option.starts_with("-d") && !option.starts_with("-ty")) continue;
    if (++word == words.end()) return true;  // Tcl's own error
    if (!option.starts_with("-d")) continue;
    if (!resolve(files, *word, FileUse::read)) return false;
    has_folder = true;
  }
  if (std::any_of(word, words.end(), leads_out)) return false;
  if (has_folder || word == words.end()) return true;
  if (files.folder().empty()) return false;
  const std::string& folder = files.folder().native();
  words.insert(words.begin() + 1,
               {Tcl_NewStringObj("-directory", -1), Tcl_NewStringObj(folder.data(), static_cast<int>(folder.size())),
                Tcl_NewStringObj("-tails", -1)});
  return true;
}

// `create` may be abbreviated.
bool makes_no_interpreter(const ScriptFiles&, Words& words) {
  return words.size() < 2 || !text(words[1]).starts_with("cr");
}

// The encoding of the system is that of the process.
bool has_no_argument(const ScriptFiles&, Words& words) { return words.size() < 2; }

bool any(const ScriptFiles&, Words&) { return true; }

struct GuardedName {
  const char* command;
  Guard guard;
  const char* refusal;  ///< null: 0 is the answer, as of a file that does not exist
};

constexpr const char* no_file =
    "a script reads and writes regular files below its scenario's folder, and below those of --allow, and no output of "
    "its run";
constexpr GuardedName guarded_names[] = {
    {"::open", open_one, no_file},
    {"::source", read_last, no_file},
    {"::glob", stay_below, no_file},
    {"::fconfigure", any, ""},
    {"::interp", makes_no_interpreter, "a script in virtual time makes no further interpreters"},
    {"::tcl::encoding::system", has_no_argument, "a script does not change the encoding of the system"},
    {"::tcl::file::copy", write_all, no_file},
    {"::tcl::file::delete", write_all, no_file},
    {"::tcl::file::dirname", any, ""},
    {"::tcl::file::executable", read_all, nullptr},
    {"::tcl::file::exists", read_all, nullptr},
    {"::tcl::file::extension", any, ""},
    {"::tcl::file::isdirectory", read_all, nullptr},
    {"::tcl::file::isfile", read_all, nullptr},
    {"::tcl::file::mkdir", write_all, no_file},
    {"::tcl::file::nativename", any, ""},
    {"::tcl::file::normalize", read_all, no_file},
    {"::tcl::file::readable", read_all, nullptr},
    {"::tcl::file::rename", write_all, no_file},
    {"::tcl::file::rootname", any, ""},
    {"::tcl::file::size", read_all, no_file},
    {"::tcl::file::tail", any, ""},
    {"::tcl::file::type", read_all, no_file},
    {"::tcl::file::writable", read_all, nullptr},
};

struct Guarded {
  const GuardedName& name;
  Tcl_CmdInfo original;
  std::shared_ptr<const ScriptFiles> files;
};

// The value of -directory, which successful calls have.
std::string folder_of(const Words& words) {
  const auto is_directory = [](Tcl_Obj* word) { return text(word).starts_with("-d"); };
  const auto option = std::find_if(words.begin() + 1, words.end(), is_directory);
  return words.end() - option < 2 ? "" : std::string(text(*(option + 1)));
}

// A folder's entries come in the order of its file system, and a symbolic link in a pattern may lead out.
int keep_own(Tcl_Interp* tcl, const ScriptFiles& files, const Words& words) {
  const std::string folder = folder_of(words);
  int count = 0;
  Tcl_Obj** names = nullptr;
  if (Tcl_ListObjGetElements(tcl, Tcl_GetObjResult(tcl), &count, &names) != TCL_OK) return TCL_ERROR;
  std::vector<Tcl_Obj*> own;
  std::copy_if(names, names + count, std::back_inserter(own), [&](Tcl_Obj* name) {
    return files.find((std::filesystem::path(folder) / text(name)).string(), FileUse::read).has_value();
  });
  const auto is_nocomplain = [](Tcl_Obj* word) { return text(word).starts_with("-n"); };
  if (own.empty() && count > 0 && std::none_of(words.begin() + 1, words.end(), is_nocomplain)) {
    Tcl_SetObjResult(tcl, Tcl_NewStringObj(no_file, -1));
    return TCL_ERROR;
  }
  std::sort(own.begin(), own.end(), [](Tcl_Obj* a, Tcl_Obj* b) { return text(a) < text(b); });
  Tcl_SetObjResult(tcl, Tcl_NewListObj(static_cast<int>(own.size()), own.data()));
  return TCL_OK;
}

int call_guarded(ClientData data, Tcl_Interp* tcl, int count, Tcl_Obj* const* given) {
  const auto& guarded = *static_cast<const Guarded*>(data);
  Words words(given, given + count);
  const bool is_allowed = guarded.name.guard(*guarded.files, words);
  for (Tcl_Obj* word : words) Tcl_IncrRefCount(word);
  int result = TCL_ERROR;
  if (is_allowed)
    result =
        guarded.original.objProc(guarded.original.objClientData, tcl, static_cast<int>(words.size()), words.data());
  else if (guarded.name.refusal == nullptr) {
    Tcl_SetObjResult(tcl, Tcl_NewIntObj(0));
    result = TCL_OK;
  } else {
    Tcl_SetObjResult(tcl, Tcl_NewStringObj(guarded.name.refusal, -1));
  }
  if (result == TCL_OK && is_allowed && guarded.name.guard == stay_below) result = keep_own(tcl, *guarded.files, words);
  for (Tcl_Obj* word : words) Tcl_DecrRefCount(word);
  return result;
}

// What a safe interpreter keeps of the machine: events and pipes, which are not in virtual time; timerate would count
// without end, since time stands still within commands; what is unsupported has addresses.
constexpr const char* deletions = R"(
  apply {{} {
    foreach name {fileevent pid timerate} { if {[llength [info commands ::$name]]} { rename ::$name {} } }
    foreach command [info commands ::tcl::unsupported::*] { rename $command {} }
    foreach {ensemble names} {
      info {hostname loaded nameofexecutable}
      chan {event pipe}
      file {system volumes}
    } {
      set map [namespace ensemble configure ::$ensemble -map]
      foreach name $names { dict unset map $name }
      if {$ensemble eq "chan"} { dict set map puts ::puts }
      namespace ensemble configure ::$ensemble -map $map
      foreach name $names { if {[llength [info commands ::tcl::${ensemble}::$name]]} { rename ::tcl::${ensemble}::$name {} } }
    }
    rename ::tcl::chan::puts {}
  }}
)";

}  // namespace

void guard_commands(Tcl_Interp* tcl, RobotLink& link) {
  const char* const library = Tcl_GetVar(tcl, "tcl_library", TCL_GLOBAL_ONLY);
  const std::string own_library = library == nullptr ? "" : library;
  const auto files = std::make_shared<const ScriptFiles>(
      link.folders(), own_library,
      [&link](const std::string& file, FileUse use) { return link.takes_file(file, use == FileUse::write); });
  std::vector<std::unique_ptr<Guarded>> all;
  all.reserve(std::size(guarded_names));
  for (const GuardedName& name : guarded_names) {
    all.push_back(std::make_unique<Guarded>(Guarded{name, {}, files}));
    Tcl_GetCommandInfo(tcl, name.command, &all.back()->original);
  }
  Tcl_MakeSafe(tcl);
  for (const char* ensemble : {"file", "encoding"}) Tcl_ExposeCommand(tcl, ensemble, ensemble);
  Tcl_SetVar(tcl, "tcl_library", own_library.c_str(), TCL_GLOBAL_ONLY);
  Tcl_Eval(tcl, deletions);
  for (std::unique_ptr<Guarded>& guarded : all) {
    Guarded* const owned = guarded.release();  // by the command
    Tcl_CreateObjCommand(tcl, owned->name.command, call_guarded, owned,
                         [](ClientData data) { delete static_cast<Guarded*>(data); });
  }
}

}  // namespace waitpoint::tcl
