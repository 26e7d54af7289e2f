// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command/system_confinement.hpp"

#include <fcntl.h>
#include <link.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <iterator>
#include <optional>
#include <utility>

#include "core/error.hpp"
#include "core/file_list.hpp"
#include "tools/command/installed_part.hpp"

namespace waitpoint::tools {
namespace {

namespace fs = std::filesystem;

// As in <linux/landlock.h>, whose older versions lack the later ones.
constexpr std::uint64_t execute = 1, write_file = 1 << 1, read_file = 1 << 2, read_folder = 1 << 3, removals = 3 << 4;
constexpr std::uint64_t makings = 0x7F << 6, refer = 1 << 13, truncate = 1 << 14;
constexpr std::uint64_t bind_and_connect = 3, abstract_sockets = 1;
constexpr int version_with_refer = 2, version_with_truncate = 3, version_with_network = 4, version_with_scopes = 6;
constexpr std::uint64_t reading = execute | read_file | read_folder,
                        of_files = execute | write_file | read_file | truncate;

struct RulesetAttributes {
  std::uint64_t files = 0, network = 0, scoped = 0;
};
struct [[gnu::packed]] RuleBelow {
  std::uint64_t allowed = 0;
  std::int32_t at = -1;
};

// Read by the C library and the dynamic linker; /proc and /sys also by a process about itself.
constexpr const char* system_folders[] = {"/usr", "/lib", "/lib64", "/bin", "/etc", "/proc", "/sys"};

// Of this process; none if the system does not confine it.
std::optional<SystemConfinement> of_this_process;

/// A set of rules; all other rights are taken away.
class Ruleset {
 public:
  explicit Ruleset(bool uses_network) {
    const long version = syscall(SYS_landlock_create_ruleset, nullptr, 0, 1);
    if (version < 1) return;
    rights_ = reading | write_file | removals | makings;
    if (version >= version_with_refer) rights_ |= refer;
    if (version >= version_with_truncate) rights_ |= truncate;
    RulesetAttributes attributes{.files = rights_};
    if (!uses_network && version >= version_with_network) attributes.network = bind_and_connect;
    if (!uses_network && version >= version_with_scopes) attributes.scoped = abstract_sockets;
    const std::size_t members = version >= version_with_scopes ? 3 : version >= version_with_network ? 2 : 1;
    set_ = static_cast<int>(syscall(SYS_landlock_create_ruleset, &attributes, members * sizeof(std::uint64_t), 0));
  }
  ~Ruleset() {
    if (set_ >= 0) close(set_);
  }
  Ruleset(const Ruleset&) = delete;
  Ruleset& operator=(const Ruleset&) = delete;

  /// A missing file needs no rule.
  void allow(const fs::path& path, std::uint64_t rights) {
    const int at = open(path.empty() ? "." : path.c_str(), O_PATH | O_CLOEXEC);
    if (at < 0) return;
    struct stat status {};
    const bool is_folder = fstat(at, &status) == 0 && S_ISDIR(status.st_mode);
    const RuleBelow rule{rights & rights_ & (is_folder ? ~std::uint64_t{0} : of_files), at};
    static_cast<void>(syscall(SYS_landlock_add_rule, set_, 1, &rule, 0));
    close(at);
  }
  void allow_all_below(const fs::path& folder) { allow(folder, ~std::uint64_t{0}); }
  /// False if the kernel cannot.
  bool restrict_this_process() const {
    return set_ >= 0 && prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
           syscall(SYS_landlock_restrict_self, set_, 0) == 0;
  }

 private:
  std::uint64_t rights_ = 0;
  int set_ = -1;
};

/// The program, its loaded objects, and the library that --record may load.
std::vector<fs::path> own_files() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  std::vector<fs::path> files = {program};
  dl_iterate_phdr(
      [](dl_phdr_info* object, std::size_t, void* into) {
        if (*object->dlpi_name != '\0') static_cast<std::vector<fs::path>*>(into)->emplace_back(object->dlpi_name);
        return 0;
      },
      &files);
  try {
    files.push_back(find_part("libwaitpoint-bags.so"));
  } catch (const BadInput&) {  // no bags are written
  }
  return files;
}

bool confine_to(const SystemConfinement& confinement) {
  Ruleset rules(confinement.uses_network);
  for (const char* folder : system_folders) rules.allow(folder, reading);
  rules.allow("/dev", reading | write_file);
  for (const fs::path& file : own_files()) rules.allow(file, reading);
  for (const fs::path& folder : confinement.folders) rules.allow(folder, read_file | read_folder);
  for (const fs::path& file : confinement.inputs) rules.allow(file, read_file);
  for (const fs::path& folder : confinement.writable) rules.allow_all_below(folder);
  return rules.restrict_this_process();
}

}  // namespace

void confine_by_system(SystemConfinement confinement) {
  if (confine_to(confinement)) {
    of_this_process = std::move(confinement);
  } else {
    std::fputs("waitpoint: --confined: the system does not enforce it, as it has no Landlock\n", stderr);
  }
}

void confine_to_listed_files() {
  if (!of_this_process) return;
  SystemConfinement listed = *std::exchange(of_this_process, std::nullopt);
  listed.folders.clear();
  for (const ListedFile& file : FileList::files())
    if (file.use == FileRole::read) listed.inputs.emplace_back(file.name);
  static_cast<void>(confine_to(listed));
}

}  // namespace waitpoint::tools
