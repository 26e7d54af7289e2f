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

/// Numbers of closed streams are not for files of this process, and cannot be written.
void occupy_closed_streams() {
  int last = 0;
  do last = ::open("/dev/null", O_RDONLY);
  while (last >= 0 && last <= STDERR_FILENO);
  close(last);
}

int open_given() {
  occupy_closed_streams();
  struct stat of {};
  const bool is_file = fstat(STDIN_FILENO, &of) == 0 && S_ISREG(of.st_mode);
  return is_file ? fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 3) : ::open("/dev/null", O_RDONLY | O_CLOEXEC);
}

std::string text_from(int file, off_t from) {
  std::string text(static_cast<std::size_t>(lseek(file, 0, SEEK_END) - from), '\0');
  const ssize_t got = pread(file, text.data(), text.size(), from);
  text.resize(static_cast<std::size_t>(std::max<ssize_t>(0, got)));
  return text;
}

}  // namespace

RunStreams::RunStreams() : given_(open_given()) {}

RunStreams::~RunStreams() {
  for (const int each : {given_, input_, output_, errors_})
    if (each >= 0) close(each);
}

void RunStreams::open(bool has_own_errors) {
  for (const int each : {input_, output_, errors_})
    if (each >= 0) close(each);
  // Not a duplicate, which would share its position.
  input_ = ::open(("/proc/self/fd/" + std::to_string(given_)).c_str(), O_RDONLY | O_CLOEXEC);
  output_ = memfd_create("waitpoint-output", MFD_CLOEXEC);
  errors_ = has_own_errors ? memfd_create("waitpoint-errors", MFD_CLOEXEC) : -1;
  shown_ = errors_shown_ = 0;
}

void RunStreams::rewind() const {
  lseek(input_, 0, SEEK_SET);
  if (lseek(output_, 0, SEEK_END) > 0 && ftruncate(output_, 0) == 0) lseek(output_, 0, SEEK_SET);
}

bool RunStreams::are_shown() { return (fcntl(STDOUT_FILENO, F_GETFL) & O_ACCMODE) != O_RDONLY; }

std::string RunStreams::new_text(int file, off_t& shown) {
  std::string text = text_from(file, shown);
  shown += static_cast<off_t>(text.size());
  return text;
}

std::string RunStreams::output_from(off_t from) const { return text_from(output_, from); }

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
