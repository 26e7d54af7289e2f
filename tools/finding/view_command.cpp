// SPDX-License-Identifier: BSD-3-Clause
#include "tools/finding/view_command.hpp"

#include <cstdio>

#include "tools/command/interruption.hpp"
#include "tools/command/options/viewing.hpp"
#include "tools/finding/finding_page.hpp"
#include "tools/finding/page_server.hpp"
#include "tools/output/output_file.hpp"

namespace waitpoint::tools {

void declare(Command& command, ViewOptions& options) {
  command.description = "Shows a finding of explore in a browser: the failing schedule beside a passing one.";
  command.examples = {"finding.json --page finding.html"};
  OptionValue file{.file = OptionValue::File::read};
  file.take = [&options](const std::string&, const std::string& text) { options.file = text; };
  command.add("FINDING", std::move(file),
              "what waitpoint explore --finding, or a test with WAITPOINT_FINDING, has written", {.is_required = true});
  declare_page(command, options.page, "write a page that opens offline, and end");
  declare_serve(command, options.serve, "serve at this address, until Ctrl-C");
  command.finally([&options] {
    if (!options.page && !options.serve) options.serve = ServeAddress();
  });
}

int view_finding(const ViewOptions& options) {
  std::string page = page_of_finding(read_finding(options.file));
  if (options.page) {
    OutputFile file(*options.page);
    file.write(page);
    file.commit();
  }
  if (!options.serve) return 0;
  heed_signals();
  PageServer server(*options.serve, std::move(page));
  std::fprintf(stderr, "waitpoint: until Ctrl-C the finding is shown at %s\n", server.url().c_str());
  server.serve([] { return interruption() != 0; });
  return 0;
}

}  // namespace waitpoint::tools
