// SPDX-License-Identifier: BSD-3-Clause
#include "tools/finding/view_command.hpp"

#include <cstdio>

#include "tools/command/distinct_files.hpp"
#include "tools/command/interruption.hpp"
#include "tools/finding/finding_page.hpp"
#include "tools/finding/page_server.hpp"
#include "tools/output/output_file.hpp"

namespace waitpoint::tools {

ViewArguments::ViewArguments(CommandLine& line)
    : command_(line.add_command(
          "view", "Shows a finding of explore in a browser: the failing schedule beside a passing one.")) {
  command_.argument("FINDING", file_,
                    "file that `waitpoint explore --finding` has written, or a test with WAITPOINT_FINDING",
                    Command::Presence::required);
  command_.option("--page", page_, "FILE.html", "write a page that opens offline, and end");
  command_.option_or_flag("--serve", serve_, "ADDRESS:PORT", "127.0.0.1:0",
                          "serve at this address, until Ctrl-C (default: at a free port of the loopback)");
}

ViewOptions ViewArguments::options() const {
  check_distinct({{"FINDING", file_, NamedFile::Use::read}, {"--page", page_}});
  ViewOptions options{file_, {}, {}};
  if (!page_.empty()) options.page = page_;
  if (page_.empty() || !serve_.empty()) options.serve = serve_address(serve_);
  return options;
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
