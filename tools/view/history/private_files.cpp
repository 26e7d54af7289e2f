// SPDX-License-Identifier: BSD-3-Clause
#include "tools/view/history/private_files.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include "core/number_text.hpp"

namespace waitpoint::tools::view {
namespace {

std::vector<int> open_descriptors() {
  std::vector<int> numbers;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd", ignored)) {
    int number = -1;
    if (parse_number(entry.path().filename().string(), number)) numbers.push_back(number);
  }
  return numbers;
}

bool is_read_file(int number) {
  struct stat status {};
  const int flags = fcntl(number, F_GETFL);
  return flags >= 0 && (flags & O_ACCMODE) == O_RDONLY && fstat(number, &status) == 0 && S_ISREG(status.st_mode);
}

void reopen(int number) {
  const off_t place = lseek(number, 0, SEEK_CUR);
  const int own = open(("/proc/self/fd/" + std::to_string(number)).c_str(), O_RDONLY | O_CLOEXEC);
  if (own < 0) return;
  lseek(own, place, SEEK_SET);
  dup3(own, number, fcntl(number, F_GETFD) & FD_CLOEXEC ? O_CLOEXEC : 0);
  close(own);
}

}  // namespace

void make_files_private(int kept) {
  const std::vector<int> numbers = open_descriptors();
  const int nothing = open("/dev/null", O_RDWR | O_CLOEXEC);
  for (const int number : numbers) {
    if (number == kept || fcntl(number, F_GETFD) < 0) continue;
    if (is_read_file(number))
      reopen(number);
    else
      dup2(nothing, number);
  }
  close(nothing);
}

}  // namespace waitpoint::tools::view
