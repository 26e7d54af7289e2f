// SPDX-License-Identifier: BSD-3-Clause
#include "tools/run/journal_file.hpp"

#include <cerrno>
#include <cstring>
#include <string>

#include "core/error.hpp"

namespace waitpoint::tools {

JournalFile::JournalFile(const std::filesystem::path& path) : path_(path), stream_(std::fopen(path.c_str(), "we")) {
  if (stream_ == nullptr) fail();
}

void JournalFile::write(std::string_view lines) {
  if (std::fwrite(lines.data(), 1, lines.size(), stream_.get()) != lines.size() || std::fflush(stream_.get()) != 0)
    fail();
}

void JournalFile::fail() const {
  throw BadInput(path_.string(), std::string("cannot be written: ") + std::strerror(errno));
}

}  // namespace waitpoint::tools
