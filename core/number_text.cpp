// SPDX-License-Identifier: BSD-3-Clause
#include "core/number_text.hpp"

#include <locale.h>
#include <stdlib.h>  // strtod_l

#include <cmath>
#include <string>

namespace waitpoint {

bool parse_number(std::string_view text, double& number) {
  if (text.empty() || text.front() == '+' || text.find_first_not_of("0123456789+-.eE") != text.npos) return false;
  static const locale_t without_locale = newlocale(LC_ALL_MASK, "C", nullptr);
  const std::string ended(text);
  char* end = nullptr;
  const double read = strtod_l(ended.c_str(), &end, without_locale);
  if (end != ended.c_str() + ended.size() || !std::isfinite(read)) return false;
  number = read;
  return true;
}

std::string counted(std::uint64_t count, std::string_view of) {
  const char* const plural = of.ends_with("ch") ? "es" : "s";
  return std::to_string(count).append(" ").append(of).append(count == 1 ? "" : plural);
}

}  // namespace waitpoint
