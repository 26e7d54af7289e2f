// SPDX-License-Identifier: BSD-3-Clause
#include "core/float_environment.hpp"

namespace waitpoint {

std::string FloatEnvironment::restore_standard() {
  const FloatEnvironment found;
  if (found.has_standard_values()) return "";
  std::string words;
  const auto add = [&words](bool is_different, const char* part) {
    if (is_different) words += (words.empty() ? "" : ", ") + std::string(part);
  };
#if WAITPOINT_X86_64
  constexpr std::uint32_t rounding = 0x6000, flushing = 0x8040, masks = 0x1F80;
  constexpr std::uint16_t stack_rounding = 0xC00, stack_precision = 0x300, stack_masks = 0x3F;
  const std::uint32_t vectors = found.vectors_ ^ standard_vectors;
  const auto stack = static_cast<std::uint16_t>(found.stack_ ^ standard_stack);
  add((vectors & rounding) != 0 || (stack & stack_rounding) != 0, "rounding");
  add((vectors & flushing) != 0, "flushing of small numbers to zero");
  add((vectors & masks) != 0 || (stack & stack_masks) != 0, "enabled exceptions");
  add((stack & stack_precision) != 0, "precision of long double");
  const std::uint32_t set = (found.vectors_ & occurred) | standard_vectors;
  asm volatile("ldmxcsr %0\n\tfldcw %1" : : "m"(set), "m"(standard_stack));
#elif WAITPOINT_AARCH64
  constexpr std::uint64_t rounding = 0xC00000, flushing = 0x1000000, exceptions = 0x9F00;
  add((found.control_ & rounding) != 0, "rounding");
  add((found.control_ & flushing) != 0, "flushing of small numbers to zero");
  add((found.control_ & exceptions) != 0, "enabled exceptions");
  asm volatile("msr fpcr, %0" : : "r"(std::uint64_t{0}));
#else
  add(true, "rounding");
  std::fesetround(FE_TONEAREST);
#endif
  return words.empty() ? "floating-point numbers" : words + " of floating-point numbers";
}

}  // namespace waitpoint
