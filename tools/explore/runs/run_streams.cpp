// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/runs/run_streams.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>

namespace waitpoint::tools {
namespace {

constexpr off_t output_shown = 2000;

int open_given() {
  struct stat of {};
  const bool is_file = fstat(STDIN_FILENO, &of) == 0 && S_ISREG(of.st_mode);
  return is_file ? fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 3) : ::open("/dev/null", O_RDONLY | O_CLOEXEC);
}

}  // namespace

RunStreams::RunStreams() : given_(open_given()) {}

RunStreams::~RunStreams() {
  for (const int each : {given_, input_, output_})
    if (each >= 0) close(each);
}

void RunStreams::open() {
  for (const int each : {input_, output_})
    if (each >= 0) close(each);
  // Not a duplicate, which would share its position.
  input_ = ::open(("/proc/self/fd/" + std::to_string(given_)).c_str(), O_RDONLY | O_CLOEXEC);
  output_ = memfd_create("waitpoint-output", MFD_CLOEXEC);
}

void RunStreams::rewind() const {
  lseek(input_, 0, SEEK_SET);
  if (lseek(output_, 0, SEEK_END) > 0 && ftruncate(output_, 0) == 0) lseek(output_, 0, SEEK_SET);
}

std::string RunStreams::output_from(off_t from) const {
  std::string text(static_cast<std::size_t>(lseek(output_, 0, SEEK_END) - from), '\0');
  const ssize_t got = pread(output_, text.data(), text.size(), from);
  text.resize(static_cast<std::size_t>(std::max<ssize_t>(0, got)));
  return text;
}

std::string RunStreams::end_of_output() const {
  const off_t from = std::max<off_t>(0, lseek(output_, 0, SEEK_END) - output_shown);
  std::string text = output_from(from);
  if (from > 0) text.erase(0, text.find('\n') + 1);
  while (text.ends_with('\n')) text.pop_back();
  std::string indented = from > 0 ? "  ..." : "";
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.size(), text.find('\n', at));
    indented += (indented.empty() ? "  " : "\n  ") + text.substr(at, end - at);
    at = end + 1;
  }
  return indented;
}

}  // namespace waitpoint::tools
