// SPDX-License-Identifier: BSD-3-Clause
#include "tools/output/output_file.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "core/error.hpp"

namespace waitpoint::tools {
namespace {

namespace fs = std::filesystem;

/// The permissions of a new file; reading the mask requires setting it.
mode_t usual_mode() {
  const mode_t mask = umask(0);
  umask(mask);
  return 0666 & ~mask;
}

}  // namespace

void OutputFile::fail() const {
  throw BadInput(path_.string(), std::string("cannot be written: ") + std::strerror(errno));
}

OutputFile::OutputFile(const fs::path& path) : path_(path), target_(path) {
  std::error_code error;
  if (fs::is_directory(path_, error)) throw BadInput(path_.string(), "cannot be written: it is a folder");
  if (fs::exists(path_, error)) {
    if (access(path_.c_str(), W_OK) != 0) fail();
    if (!fs::is_regular_file(path_, error)) {
      stream_.reset(std::fopen(path_.c_str(), "we"));
      if (!stream_) fail();
      return;
    }
    // Through a link, the target is replaced, not the link.
    target_ = fs::canonical(path_, error);
    if (error) target_ = path_;
  }
  std::string pattern = target_.string() + ".XXXXXX";
  const int descriptor = mkstemp(pattern.data());
  if (descriptor < 0) fail();
  temporary_ = pattern;
  fchmod(descriptor, usual_mode());
  stream_.reset(fdopen(descriptor, "w"));
  if (!stream_) fail();
}

OutputFile::~OutputFile() {
  std::error_code ignored;
  if (stream_ && !temporary_.empty()) fs::remove(temporary_, ignored);
}

void OutputFile::write(std::string_view text) {
  WAITPOINT_CHECK(stream_ != nullptr, "a file is written after its commit");
  if (std::fwrite(text.data(), 1, text.size(), stream_.get()) != text.size()) fail();
}

void OutputFile::commit() {
  WAITPOINT_CHECK(stream_ != nullptr, "a file is committed twice");
  if (std::fflush(stream_.get()) != 0) fail();
  if (!temporary_.empty() && std::rename(temporary_.c_str(), target_.c_str()) != 0) fail();
  stream_.reset();
}

void flush_standard_output() {
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) throw BadInput("standard output", "cannot be written");
}

}  // namespace waitpoint::tools
