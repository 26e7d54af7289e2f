// SPDX-License-Identifier: BSD-3-Clause
//
// The calls of the C library that the layer passes through, with their footprints: one table. Calls that the layer
// replaces declare theirs where they are defined, by before_call().
//
// A row is the function itself, which takes any arguments: it passes its event, then goes on in the C library.
#include "fibers/posix/exec/passed_calls.hpp"

#include <dlfcn.h>
#include <fcntl.h>

#include <cstdio>

#include "core/error.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/program/file_places.hpp"
#include "fibers/posix/program/state_calls.hpp"
#include "fibers/posix/traps/library_range.hpp"

namespace waitpoint::posix {
namespace {

/// The words of a call: those in the registers of arguments, and the address to which it returns.
struct PassedWords {
  const long* at;

  int number(int which) const { return static_cast<int>(at[which]); }
  const char* text(int which) const { return reinterpret_cast<const char*>(at[which]); }
  FILE* stream(int which) const { return reinterpret_cast<FILE*>(at[which]); }
  std::uintptr_t returns_to() const { return static_cast<std::uintptr_t>(at[7]); }
};

/// A row of the table. Aligned, so that the compiler puts no more space between rows than an array has.
struct alignas(64) PassedCall {
  kernel::Object function;
  EventFootprint (*footprint)(const PassedWords& of);
  void* of_library = nullptr;
};

// The layer's own calls are no events.
bool is_of_layer(std::uintptr_t address) {
  static constexpr char of_layer = 0;
  static constinit LibraryRange layer{0, 0};
  if (layer.end == 0) layer = range_of_library_with(&of_layer);
  return layer.contains(address);
}

// Of a stream that the thread has locked, no other thread can pass a call.
bool is_locked(FILE* stream) {
  struct Lock {
    int lock, count;
    void* owner;
  };
  return stream->_lock != nullptr && static_cast<const Lock*>(stream->_lock)->lock != 0;
}

EventFootprint at_stream(FILE* stream) {
  if (stream == nullptr) return changing(place::files);
  return stream == stdout || stream == stderr || is_locked(stream) ? EventFootprint() : changing_stream(stream);
}

void look_up(PassedCall& call) {
  const ErrorNumberKept kept;
  call.of_library = dlsym(RTLD_NEXT, call.function.label);
  WAITPOINT_CHECK(call.of_library != nullptr, "the C library lacks a function that the layer passes through");
}

}  // namespace

// The rows, which the linker puts side by side.
extern "C" [[gnu::visibility("hidden")]] PassedCall __start_passed_calls[], __stop_passed_calls[];

void look_up_passed_calls() {
  for (PassedCall* call = __start_passed_calls; call != __stop_passed_calls; ++call) look_up(*call);
}

// The C library's function, to which the call goes on.
extern "C" [[gnu::visibility("hidden"), gnu::used]] void* waitpoint_pass_call(PassedCall& call, const long* words) {
  if (call.of_library == nullptr) look_up(call);
  const PassedWords of{words};
  if (!are_calls_events() || is_of_layer(of.returns_to())) return call.of_library;
  if (const EventFootprint first = call.footprint(of); first != EventFootprint())
    before_call(call.function, [&] { return call.footprint(of); });
  return call.of_library;
}

}  // namespace waitpoint::posix

// %r11: the row.
asm(R"(
  .text
  .type waitpoint_passed_call, @function
waitpoint_passed_call:
  .cfi_startproc
  pushq %rax
  .cfi_adjust_cfa_offset 8
  pushq %r9
  .cfi_adjust_cfa_offset 8
  pushq %r8
  .cfi_adjust_cfa_offset 8
  pushq %rcx
  .cfi_adjust_cfa_offset 8
  pushq %rdx
  .cfi_adjust_cfa_offset 8
  pushq %rsi
  .cfi_adjust_cfa_offset 8
  pushq %rdi
  .cfi_adjust_cfa_offset 8
  subq $128, %rsp
  .cfi_adjust_cfa_offset 128
  movaps %xmm0, (%rsp)
  movaps %xmm1, 16(%rsp)
  movaps %xmm2, 32(%rsp)
  movaps %xmm3, 48(%rsp)
  movaps %xmm4, 64(%rsp)
  movaps %xmm5, 80(%rsp)
  movaps %xmm6, 96(%rsp)
  movaps %xmm7, 112(%rsp)
  movq %r11, %rdi
  leaq 128(%rsp), %rsi
  call waitpoint_pass_call
  movq %rax, %r11
  movaps (%rsp), %xmm0
  movaps 16(%rsp), %xmm1
  movaps 32(%rsp), %xmm2
  movaps 48(%rsp), %xmm3
  movaps 64(%rsp), %xmm4
  movaps 80(%rsp), %xmm5
  movaps 96(%rsp), %xmm6
  movaps 112(%rsp), %xmm7
  addq $128, %rsp
  .cfi_adjust_cfa_offset -128
  popq %rdi
  .cfi_adjust_cfa_offset -8
  popq %rsi
  .cfi_adjust_cfa_offset -8
  popq %rdx
  .cfi_adjust_cfa_offset -8
  popq %rcx
  .cfi_adjust_cfa_offset -8
  popq %r8
  .cfi_adjust_cfa_offset -8
  popq %r9
  .cfi_adjust_cfa_offset -8
  popq %rax
  .cfi_adjust_cfa_offset -8
  jmpq *%r11
  .cfi_endproc
  .size waitpoint_passed_call, .-waitpoint_passed_call
)");

/// A row: the function's name, and its footprint as an expression of the words `of` the call.
#define WAITPOINT_PASSED(name, ...)                                                                                 \
  namespace waitpoint::posix {                                                                                      \
  extern "C" {                                                                                                      \
  [[gnu::visibility("hidden"), gnu::used, gnu::section("passed_calls")]] constinit PassedCall waitpoint_row_##name{ \
      kernel::Object("function", #name),                                                                            \
      [](const PassedWords& of [[maybe_unused]]) -> EventFootprint { return __VA_ARGS__; }};                        \
  }                                                                                                                 \
  }                                                                                                                 \
  asm("  .text\n"                                                                                                   \
      "  .globl " #name                                                                                             \
      "\n"                                                                                                          \
      "  .type " #name ", @function\n" #name                                                                        \
      ":\n"                                                                                                         \
      "  .cfi_startproc\n"                                                                                          \
      "  endbr64\n"                                                                                                 \
      "  leaq waitpoint_row_" #name                                                                                 \
      "(%rip), %r11\n"                                                                                              \
      "  jmp waitpoint_passed_call\n"                                                                               \
      "  .cfi_endproc\n"                                                                                            \
      "  .size " #name ", .-" #name "\n")

// Names of files.
WAITPOINT_PASSED(unlink, changing_name(AT_FDCWD, of.text(0)));
WAITPOINT_PASSED(unlinkat, changing_name(of.number(0), of.text(1)));
WAITPOINT_PASSED(remove, changing_name(AT_FDCWD, of.text(0)));
WAITPOINT_PASSED(rename, renaming(AT_FDCWD, of.text(0), AT_FDCWD, of.text(1)));
WAITPOINT_PASSED(renameat, renaming(of.number(0), of.text(1), of.number(2), of.text(3)));
WAITPOINT_PASSED(renameat2, renaming(of.number(0), of.text(1), of.number(2), of.text(3)));
WAITPOINT_PASSED(mkdir, changing_name(AT_FDCWD, of.text(0)) | reading(place::creation_mask));
WAITPOINT_PASSED(mkdirat, changing_name(of.number(0), of.text(1)) | reading(place::creation_mask));
WAITPOINT_PASSED(rmdir, changing_name(AT_FDCWD, of.text(0)));
WAITPOINT_PASSED(mkfifo, changing_name(AT_FDCWD, of.text(0)) | reading(place::creation_mask));
WAITPOINT_PASSED(mkfifoat, changing_name(of.number(0), of.text(1)) | reading(place::creation_mask));
WAITPOINT_PASSED(mknod, changing_name(AT_FDCWD, of.text(0)) | reading(place::creation_mask));
WAITPOINT_PASSED(mknodat, changing_name(of.number(0), of.text(1)) | reading(place::creation_mask));
WAITPOINT_PASSED(link, changing(place::files) | reading(place::directory));
WAITPOINT_PASSED(linkat, changing(place::files) | reading(place::directory | place::descriptors));
WAITPOINT_PASSED(symlink, changing(place::files) | reading(place::directory));
WAITPOINT_PASSED(symlinkat, changing(place::files) | reading(place::directory | place::descriptors));
WAITPOINT_PASSED(chmod, changing_file(AT_FDCWD, of.text(0)));
WAITPOINT_PASSED(fchmodat, changing_file(of.number(0), of.text(1)));
WAITPOINT_PASSED(chown, changing_file(AT_FDCWD, of.text(0)));
WAITPOINT_PASSED(lchown, changing_file(AT_FDCWD, of.text(0), false));
WAITPOINT_PASSED(fchownat, changing_file(of.number(0), of.text(1)) | changing_file(of.number(0), of.text(1), false));
WAITPOINT_PASSED(truncate, changing_file(AT_FDCWD, of.text(0)));
WAITPOINT_PASSED(truncate64, changing_file(AT_FDCWD, of.text(0)));
WAITPOINT_PASSED(euidaccess, reading_name(AT_FDCWD, of.text(0)));
WAITPOINT_PASSED(eaccess, reading_name(AT_FDCWD, of.text(0)));
WAITPOINT_PASSED(realpath, reading_name(AT_FDCWD, of.text(0)));
WAITPOINT_PASSED(__realpath_chk, reading_name(AT_FDCWD, of.text(0)));
WAITPOINT_PASSED(canonicalize_file_name, reading_name(AT_FDCWD, of.text(0)));
WAITPOINT_PASSED(glob, reading(place::files | place::directory));
WAITPOINT_PASSED(glob64, reading(place::files | place::directory));
WAITPOINT_PASSED(ftw, reading(place::files | place::directory));
WAITPOINT_PASSED(ftw64, reading(place::files | place::directory));
WAITPOINT_PASSED(nftw, reading(place::files | place::directory));
WAITPOINT_PASSED(nftw64, reading(place::files | place::directory));

// Open files.
WAITPOINT_PASSED(lseek, changing_at(of.number(0)));
WAITPOINT_PASSED(lseek64, changing_at(of.number(0)));
WAITPOINT_PASSED(ftruncate, changing_at(of.number(0)));
WAITPOINT_PASSED(ftruncate64, changing_at(of.number(0)));
WAITPOINT_PASSED(posix_fallocate, changing_at(of.number(0)));
WAITPOINT_PASSED(posix_fallocate64, changing_at(of.number(0)));
WAITPOINT_PASSED(fchmod, changing_at(of.number(0)));
WAITPOINT_PASSED(fchown, changing_at(of.number(0)));
WAITPOINT_PASSED(copy_file_range, changing_at(of.number(0)) | changing_at(of.number(2)));
WAITPOINT_PASSED(isatty, reading_at(of.number(0)));
WAITPOINT_PASSED(getsockname, reading_at(of.number(0)));
WAITPOINT_PASSED(getpeername, reading_at(of.number(0)));

// Streams; those of the standard outputs only where they are positioned.
WAITPOINT_PASSED(fseek, at_stream(of.stream(0)));
WAITPOINT_PASSED(fseeko, at_stream(of.stream(0)));
WAITPOINT_PASSED(fseeko64, at_stream(of.stream(0)));
WAITPOINT_PASSED(ftell, at_stream(of.stream(0)));
WAITPOINT_PASSED(ftello, at_stream(of.stream(0)));
WAITPOINT_PASSED(ftello64, at_stream(of.stream(0)));
WAITPOINT_PASSED(rewind, at_stream(of.stream(0)));
WAITPOINT_PASSED(fgetpos, at_stream(of.stream(0)));
WAITPOINT_PASSED(fgetpos64, at_stream(of.stream(0)));
WAITPOINT_PASSED(fsetpos, at_stream(of.stream(0)));
WAITPOINT_PASSED(fsetpos64, at_stream(of.stream(0)));
WAITPOINT_PASSED(fread, at_stream(of.stream(3)));
WAITPOINT_PASSED(__fread_chk, at_stream(of.stream(4)));
WAITPOINT_PASSED(fwrite, at_stream(of.stream(3)));
WAITPOINT_PASSED(fgets, at_stream(of.stream(2)));
WAITPOINT_PASSED(__fgets_chk, at_stream(of.stream(3)));
WAITPOINT_PASSED(fputs, at_stream(of.stream(1)));
WAITPOINT_PASSED(fgetc, at_stream(of.stream(0)));
WAITPOINT_PASSED(getc, at_stream(of.stream(0)));
WAITPOINT_PASSED(getchar, at_stream(stdin));
WAITPOINT_PASSED(fputc, at_stream(of.stream(1)));
WAITPOINT_PASSED(putc, at_stream(of.stream(1)));
WAITPOINT_PASSED(ungetc, at_stream(of.stream(1)));
WAITPOINT_PASSED(getline, at_stream(of.stream(2)));
WAITPOINT_PASSED(getdelim, at_stream(of.stream(3)));
WAITPOINT_PASSED(__getdelim, at_stream(of.stream(3)));
WAITPOINT_PASSED(fprintf, at_stream(of.stream(0)));
WAITPOINT_PASSED(vfprintf, at_stream(of.stream(0)));
WAITPOINT_PASSED(__fprintf_chk, at_stream(of.stream(0)));
WAITPOINT_PASSED(__vfprintf_chk, at_stream(of.stream(0)));
WAITPOINT_PASSED(fscanf, at_stream(of.stream(0)));
WAITPOINT_PASSED(vfscanf, at_stream(of.stream(0)));
WAITPOINT_PASSED(__isoc99_fscanf, at_stream(of.stream(0)));
WAITPOINT_PASSED(__isoc99_vfscanf, at_stream(of.stream(0)));
WAITPOINT_PASSED(fflush, at_stream(of.stream(0)));
WAITPOINT_PASSED(feof, at_stream(of.stream(0)));
WAITPOINT_PASSED(ferror, at_stream(of.stream(0)));
WAITPOINT_PASSED(clearerr, at_stream(of.stream(0)));
WAITPOINT_PASSED(setvbuf, at_stream(of.stream(0)));
WAITPOINT_PASSED(freopen, at_stream(of.stream(2)) | opening(AT_FDCWD, of.text(0), O_RDWR | O_CREAT | O_TRUNC));
WAITPOINT_PASSED(freopen64, at_stream(of.stream(2)) | opening(AT_FDCWD, of.text(0), O_RDWR | O_CREAT | O_TRUNC));

// Message queues.
WAITPOINT_PASSED(mq_open, changing(place::channels | place::descriptors | place::objects));
WAITPOINT_PASSED(mq_close, changing(place::channels | place::descriptors));
WAITPOINT_PASSED(mq_unlink, changing(place::objects));
WAITPOINT_PASSED(mq_getattr, reading(place::channels | place::descriptors));
WAITPOINT_PASSED(mq_setattr, changing(place::channels) | reading(place::descriptors));

// The process.
WAITPOINT_PASSED(getenv, reading(place::environment));
WAITPOINT_PASSED(secure_getenv, reading(place::environment));
WAITPOINT_PASSED(setenv, changing(place::environment));
WAITPOINT_PASSED(unsetenv, changing(place::environment));
WAITPOINT_PASSED(putenv, changing(place::environment));
WAITPOINT_PASSED(clearenv, changing(place::environment));
WAITPOINT_PASSED(chdir, changing(place::directory) | reading_name(AT_FDCWD, of.text(0)));
WAITPOINT_PASSED(fchdir, changing(place::directory) | reading_at(of.number(0)));
WAITPOINT_PASSED(getcwd, reading(place::directory));
WAITPOINT_PASSED(__getcwd_chk, reading(place::directory));
WAITPOINT_PASSED(get_current_dir_name, reading(place::directory | place::environment));
WAITPOINT_PASSED(umask, changing(place::creation_mask));
WAITPOINT_PASSED(getrlimit, reading(place::process));
WAITPOINT_PASSED(getrlimit64, reading(place::process));
WAITPOINT_PASSED(setrlimit, changing(place::process | place::descriptors));
WAITPOINT_PASSED(setrlimit64, changing(place::process | place::descriptors));
WAITPOINT_PASSED(prlimit, changing(place::process | place::descriptors));
WAITPOINT_PASSED(prlimit64, changing(place::process | place::descriptors));
WAITPOINT_PASSED(getuid, reading(place::process));
WAITPOINT_PASSED(geteuid, reading(place::process));
WAITPOINT_PASSED(getgid, reading(place::process));
WAITPOINT_PASSED(getegid, reading(place::process));
WAITPOINT_PASSED(setuid, changing(place::process | place::files));
WAITPOINT_PASSED(seteuid, changing(place::process | place::files));
WAITPOINT_PASSED(setgid, changing(place::process | place::files));
WAITPOINT_PASSED(setegid, changing(place::process | place::files));
WAITPOINT_PASSED(gethostname, reading(place::process));
WAITPOINT_PASSED(sethostname, changing(place::process));

// Random numbers.
WAITPOINT_PASSED(rand, changing(place::random));
WAITPOINT_PASSED(srand, changing(place::random));
WAITPOINT_PASSED(random, changing(place::random));
WAITPOINT_PASSED(srandom, changing(place::random));
WAITPOINT_PASSED(initstate, changing(place::random));
WAITPOINT_PASSED(setstate, changing(place::random));
WAITPOINT_PASSED(drand48, changing(place::random));
WAITPOINT_PASSED(erand48, changing(place::random));
WAITPOINT_PASSED(lrand48, changing(place::random));
WAITPOINT_PASSED(nrand48, changing(place::random));
WAITPOINT_PASSED(mrand48, changing(place::random));
WAITPOINT_PASSED(jrand48, changing(place::random));
WAITPOINT_PASSED(srand48, changing(place::random));
WAITPOINT_PASSED(seed48, changing(place::random));
WAITPOINT_PASSED(lcong48, changing(place::random));

// What the C library keeps between calls.
WAITPOINT_PASSED(strtok, changing(place::library));
WAITPOINT_PASSED(asctime, changing(place::library));
WAITPOINT_PASSED(ctime, changing(place::library));
WAITPOINT_PASSED(gmtime, changing(place::library));
WAITPOINT_PASSED(localtime, changing(place::library));
WAITPOINT_PASSED(setlocale, changing(place::library));
WAITPOINT_PASSED(localeconv, changing(place::library));
WAITPOINT_PASSED(hcreate, changing(place::library));
WAITPOINT_PASSED(hsearch, changing(place::library));
WAITPOINT_PASSED(hdestroy, changing(place::library));
