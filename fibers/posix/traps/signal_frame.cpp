// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/traps/signal_frame.hpp"

#include <cstdint>
#include <cstring>

namespace waitpoint::posix {
namespace {

// The registers of vectors and floats, as the processor saves them: the system notes in a reserved part of the first
// 512 bytes how many there are in all.
std::size_t bytes_of_vectors(const void* saved) {
  constexpr std::size_t least = 512, note_at = 464;
  constexpr std::uint32_t is_noted = 0x46505853;
  std::uint32_t note[2];
  std::memcpy(note, static_cast<const char*>(saved) + note_at, sizeof note);
  return note[0] == is_noted ? note[1] : least;
}

}  // namespace

// In the order of their addresses: the handler's return address, the context, the information, the vectors.
void continue_on(void* top, siginfo_t* information, ucontext_t* context, SignalHandler handler) {
  char* const frame = reinterpret_cast<char*>(context) - sizeof(void*);
  char* end = reinterpret_cast<char*>(information + 1);
  if (char* const vectors = reinterpret_cast<char*>(context->uc_mcontext.fpregs); vectors != nullptr)
    end = vectors + bytes_of_vectors(vectors);
  // The processor expects them at a multiple of 64.
  constexpr std::uintptr_t alignment = 64;
  const auto room = reinterpret_cast<std::uintptr_t>(top) - static_cast<std::uintptr_t>(end - frame);
  const auto at = reinterpret_cast<std::uintptr_t>(frame);
  char* const copy = reinterpret_cast<char*>(room - (room - at) % alignment);
  std::memmove(copy, frame, static_cast<std::size_t>(end - frame));
  const auto moved = [&](auto* part) {
    return reinterpret_cast<decltype(part)>(copy + (reinterpret_cast<char*>(part) - frame));
  };
  ucontext_t* const new_context = moved(context);
  if (context->uc_mcontext.fpregs != nullptr) new_context->uc_mcontext.fpregs = moved(context->uc_mcontext.fpregs);
  asm volatile(
      "movq %[copy], %%rsp\n\t"
      "jmpq *%[handler]"
      :
      : [copy] "r"(copy), [handler] "r"(handler), "D"(moved(information)), "S"(new_context)
      : "memory");
  __builtin_unreachable();
}

}  // namespace waitpoint::posix
