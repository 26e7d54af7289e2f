// SPDX-License-Identifier: BSD-3-Clause
#include "tools/main.hpp"

#include <cstdio>
#include <optional>
#include <string>
#include <string_view>

#include "core/confinement.hpp"
#include "core/exception_text.hpp"
#include "core/file_list.hpp"
#include "core/printable_line.hpp"
#include "core/process_state.hpp"
#include "fibers/kernel/fault_reports.hpp"
#include "fibers/kernel/process_end.hpp"
#include "fibers/sync/post_mortem.hpp"
#include "tools/check/self_check.hpp"
#include "tools/check_command.hpp"
#include "tools/command/interruption.hpp"
#include "tools/command/version.hpp"
#include "tools/exec/exec.hpp"
#include "tools/exec/program_process.hpp"
#include "tools/explore/explore.hpp"
#include "tools/fit/compare.hpp"
#include "tools/fit/fit.hpp"
#include "tools/gdb/debug.hpp"
#include "tools/genom/genom.hpp"
#include "tools/options.hpp"
#include "tools/output/output_file.hpp"
#include "tools/papers_modules.hpp"
#include "tools/ranks/launcher.hpp"
#include "tools/replay/replay.hpp"
#include "tools/run/run.hpp"
#include "tools/run/run_watchdog.hpp"
#include "tools/schema/schema_command.hpp"
#include "tools/tcl_library.hpp"

namespace waitpoint {
namespace {

int carry_out(int argc, const char* const* argv, std::vector<genom::ModuleType> own) {
  // Of two types of one name the first counts.
  std::vector<genom::ModuleType> types = std::move(own);
  for (genom::ModuleType& type : tools::shipped_modules()) types.push_back(std::move(type));
  if (const std::string floats = FloatEnvironment::restore_standard(); !floats.empty())
    report_changed_surroundings("the program, or a library that it loads, before main()", {floats});
  const kernel::FaultReports reports(nullptr);  // also of constructors; once for all windows of a run
  kernel::set_call_stack_writer(sync::write_call_stack);
  tools::prefer_errors_to_signals();
  tools::find_tcl();
  const FileList files;
  try {
    const tools::Options options = tools::read_options(argc, argv, tools::version_text());
    std::optional<Confinement> confinement;
    const auto* const as_run = std::get_if<tools::RunOptions>(&options);
    const bool has_ranks = tools::is_rank() || (as_run != nullptr && as_run->ranks > 1);
    const auto confine = [&](const auto& given) {
      if constexpr (requires { given.confined_to; })
        if (!given.confined_to.empty()) confinement.emplace(given.confined_to);
      // Ranks need the network and files of their own.
      if constexpr (requires { given.system; })
        if (given.is_confined && !has_ranks) tools::confine_by_system(given.system);
    };
    std::visit(confine, options);
    if (const auto* run = std::get_if<tools::RunOptions>(&options))
      return run->verify ? tools::self_check(*run, types) : tools::run(*run, types);
    if (const auto* checked = std::get_if<tools::CheckOptions>(&options)) return tools::check(*checked, types);
    if (const auto* replay = std::get_if<tools::ReplayOptions>(&options)) {
      if (replay->verify) return tools::self_check(*replay, types);
      const tools::RunWatchdog watchdog(tools::RunWatchdog::usual_limit_s);
      return tools::replay_log(*replay, types);
    }
    if (const auto* fitted = std::get_if<tools::FitOptions>(&options)) return tools::fit(*fitted, types);
    if (const auto* compared = std::get_if<tools::CompareOptions>(&options)) return tools::compare(*compared, types);
    if (const auto* plan = std::get_if<tools::PlanOptions>(&options)) return tools::show_plan(*plan);
    if (const auto* schema = std::get_if<tools::SchemaOptions>(&options)) return tools::show_schema(*schema, types);
    if (const auto* viewed = std::get_if<tools::ViewOptions>(&options)) return tools::view_finding(*viewed);
    if (const auto* listed = std::get_if<tools::ScenariosOptions>(&options)) return tools::list_scenarios(*listed);
    if (const auto* generated = std::get_if<tools::GenomOptions>(&options)) return tools::genom(*generated);
    if (const auto* debug = std::get_if<tools::DebugOptions>(&options)) tools::debug(*debug);
    if (const auto* executed = std::get_if<tools::ExecOptions>(&options)) return tools::exec(*executed);
    if (const auto* explored = std::get_if<tools::ExploreOptions>(&options)) {
      std::optional<tools::RunWatchdog> watchdog;  // for constructors in this process: runs have --schedule-limit
      if (explored->program.empty()) watchdog.emplace(tools::RunWatchdog::usual_limit_s);
      return tools::explore(*explored, types);
    }
    tools::write_standard_output(std::get<tools::ShownText>(options).text);
    return 0;
  } catch (const BadInput& error) {
    std::fflush(stdout);
    std::fprintf(stderr, "waitpoint: %s\n", error.what());
    // Every other status may be the program's own.
    const bool is_exec = argc > 1 && std::string_view(argv[1]) == "exec";
    return is_exec ? tools::exec_failed : 2;
  } catch (const std::exception& error) {
    std::fflush(stdout);
    std::fprintf(stderr, "waitpoint: the run failed: %s\n", printable_message(exception_text(error)).c_str());
    return 1;
  }
}

}  // namespace

int main(int argc, const char* const* argv, std::vector<genom::ModuleType> own) {
  const int status = tools::give_status(carry_out(argc, argv, std::move(own)));
  kernel::set_exit_status(status);
  return status;
}

}  // namespace waitpoint
