// SPDX-License-Identifier: BSD-3-Clause
#include "tools/run/journal_file.hpp"

#include "modules/run/journal.hpp"

namespace waitpoint::tools {

void JournalFile::write(std::string_view lines) {
  file_.write(lines);
  file_.flush();
}

void JournalFile::cut_off(const std::string& reason) {
  write(run::cut_off_line(reason));
  commit();
}

}  // namespace waitpoint::tools
