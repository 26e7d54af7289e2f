// SPDX-License-Identifier: BSD-3-Clause
#include "tools/view/page.hpp"

#include "core/error.hpp"

namespace waitpoint::tools::view {

std::string_view page() {
  const std::span<const unsigned char> bytes = page_file();
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string page_of(std::string_view run) {
  constexpr std::string_view mark = "<!--run-->";
  std::string text(page());
  const std::size_t at = text.find(mark);
  WAITPOINT_CHECK(at != std::string::npos, "the page has no place for a run");
  text.replace(at, mark.size(), std::string("<script id=\"run\" type=\"text/plain\">").append(run).append("</script>"));
  return text;
}

}  // namespace waitpoint::tools::view
