// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/host/process_host.hpp"

#include <fcntl.h>
#include <linux/futex.h>
#include <sys/mman.h>
#include <sys/personality.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <new>

#include "core/program_path.hpp"
#include "fibers/kernel/common_order.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/kernel/timers.hpp"
#include "fibers/posix/base/direct_call.hpp"
#include "fibers/posix/family/keys.hpp"
#include "fibers/posix/family/system_processes.hpp"

namespace waitpoint::posix {
namespace {

using family::Family;
using family::Process;

// Directly: waits of the simulator's own are no misuse by a task.
void futex(std::atomic<std::uint32_t>& word, int operation, std::uint32_t value, const timespec* timeout) {
  call_directly(SYS_futex, reinterpret_cast<long>(&word), operation, value, reinterpret_cast<long>(timeout));
}
[[noreturn]] void fail(const HostedProgram& program) {
  throw HostingError("the system makes no process for program '" + program.name + "'");
}

void sleep_really(const timespec& span) { call_directly(SYS_nanosleep, reinterpret_cast<long>(&span)); }

}  // namespace

ProcessHost::ProcessHost(kernel::Scheduler& scheduler, std::filesystem::path library)
    : scheduler_(scheduler), library_(std::move(library)) {
  file_ = memfd_create("waitpoint-family", MFD_CLOEXEC);
  if (file_ < 0 || ftruncate(file_, run_bytes) != 0) return;
  // Anywhere: a host has a family in each of its runs. In the programs it is at the address that its arena has.
  void* const memory = mmap(nullptr, family_bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_NORESERVE, file_,
                            static_cast<off_t>(record_bytes));
  if (memory == MAP_FAILED) return;
  family_ = new (memory) Family;
  // In the explored order the strategy decides between the host's tasks; the programs' order is drawn from the seed.
  family_->settings.seed = kernel::chooser(scheduler).seed();
  family_->settings.simulates_started = true;
  family_->settings.idle_limit = Duration();
  family_->file = {getpid(), file_};
  family_->arena.start(reinterpret_cast<Family*>(family_address) + 1,
                       reinterpret_cast<char*>(family_address + family_bytes));
  Process& host = *add_process(nullptr);
  host.real_id = getpid();
  limit_.node.fire = fire;
  limit_.host = this;
}

ProcessHost::~ProcessHost() {
  if (limit_.node.in_list()) kernel::cancel(scheduler_, limit_.node);
  const bool is_own =
      family_ != nullptr && family_->file.watcher == getpid();  // else of the process that forked this one
  if (is_own) {
    for (const Process& process : family::entries_of(*family_).subspan(1))
      if (process.state != Process::State::none && process.state != Process::State::ended && process.real_id > 0)
        kill(process.real_id, SIGKILL);
    for (const Program& program : programs_)
      if (program.process != nullptr) waitpid(program.process->real_id, nullptr, 0);
  }
  if (family_ != nullptr) munmap(family_, family_bytes);
  if (file_ >= 0) close(file_);
}

Process* ProcessHost::add_process(const Process* parent) {
  if (family_->entries == family::processes_max) return nullptr;
  Process& made = *new (family_->processes + family_->entries++) Process();
  made.state = Process::State::alive;
  made.id = ++family_->last_id;
  made.parent = parent != nullptr ? parent->id : family::no_parent;
  made.group = made.session = parent != nullptr ? parent->group : made.id;
  ++family_->made;
  ++family_->alive;
  return &made;
}

void ProcessHost::add(const HostedProgram& program) {
  if (find_program(program.words.front()).empty())
    throw HostingError("there is no program '" + program.words.front() + "'");
  programs_.push_back({program, &robot_of(scheduler_, program)});
}

void ProcessHost::start(std::size_t number) {
  Program& program = programs_[number];
  Process* const process = family_ != nullptr ? add_process(&own()) : nullptr;
  if (process == nullptr) fail(program.hosted);
  const std::uint64_t tie = family::tie_of_first(family_->settings.seed, program.robot->id, *process);
  process->next = {kernel::global_time(scheduler_), kernel::make_order(kernel::Phase::tasks, tie)};
  program.process = process;
  std::fflush(nullptr);
  const pid_t host = getpid(), child = fork();
  if (child == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != host) _exit(ProgramEnd::not_started);
    execute(program, host);
  }
  if (child < 0) {
    process->state = Process::State::none;
    --family_->alive;
    program.process = nullptr;
    fail(program.hosted);
  }
  process->real_id = child;
  set_limit();
}

// In the child.
void ProcessHost::execute(const Program& program, pid_t host) const {
  const int persona = personality(0xFFFFFFFF);
  if (persona >= 0) personality(static_cast<unsigned long>(persona) | ADDR_NO_RANDOMIZE);
  if (const int nothing = open("/dev/null", O_RDONLY); nothing > 0) dup2(nothing, STDIN_FILENO);
  std::vector<std::string> environment = {"LD_PRELOAD=" + library_.string(),
                                          std::string(name_variable) + "=" + program.hosted.name};
  char place[64];
  // Of one length in every run: the addresses on the stack depend on it.
  std::snprintf(place, sizeof place, "%s=%09d:%05d:%04d", record_variable, host, file_,
                static_cast<int>(program.process - family_->processes));
  environment.emplace_back(place);
  for (std::string& variable : environment) putenv(variable.data());
  std::vector<char*> words;
  words.reserve(program.hosted.words.size() + 1);
  for (const std::string& word : program.hosted.words) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  execvp(words[0], words.data());
  _exit(ProgramEnd::not_started);
}

std::optional<ProgramEnd> ProcessHost::end_of(std::size_t program) const {
  const Process* const process = programs_[program].process;
  if (process == nullptr || process->state != Process::State::ended) return std::nullopt;
  return ProgramEnd(process->status);
}

void ProcessHost::set_limit() {
  if (limit_.node.in_list()) kernel::cancel(scheduler_, limit_.node);
  const Process* const least = family::least_other(*family_, own());
  kernel::EventKey key = least != nullptr ? family::key_of(*family_, *least) : kernel::EventKey::never();
  if (key.time == Time::max()) return;
  // In the explored order, behind the host's tasks of the instant.
  if (kernel::chooser(scheduler_).order() == kernel::Order::explored)
    key.order = kernel::make_order(kernel::Phase::processors, kernel::tie_mask);
  if (key.time < kernel::global_time(scheduler_)) key.time = kernel::global_time(scheduler_);
  kernel::schedule(scheduler_, limit_.node, key);
}

void ProcessHost::fire(kernel::EventNode& node) { reinterpret_cast<Limit&>(node).host->hand_over(); }

void ProcessHost::hand_over() {
  Family& all = *family_;
  all.now = std::max(all.now, kernel::global_time(scheduler_));
  own().next = kernel::next_key(scheduler_);
  own().letters = 0;  // their statuses are in the table
  Process* const least = family::least_other(all, own());
  if (least != nullptr && family::key_of(all, *least).time != Time::max()) {
    own().is_rung = false;
    ++all.hand_overs;
    all.holder = static_cast<std::uint32_t>(least - all.processes);
    least->has_turn = 1;
    futex(least->has_turn, FUTEX_WAKE, 1, nullptr);
    await_turn();
    own().is_rung = false;
    programs_.front().robot->digest_in_use->add(digest(), static_cast<std::uint64_t>(all.now.ns()));
  }
  set_limit();
}

void ProcessHost::await_turn() {
  constexpr timespec patience{0, 20'000'000};
  while (own().has_turn.exchange(0) == 0) {
    futex(own().has_turn, FUTEX_WAIT, 0, &patience);
    if (own().has_turn == 0) take_from_killed();
  }
  await_end_of_leaving();
}

// A process that was killed while it had the turn, or has not got so far as to join.
void ProcessHost::take_from_killed() {
  Process& holder = family_->processes[family_->holder];
  if (&holder == &own() || holder.real_id == 0 || family::is_running(holder.real_id)) return;
  if (holder.state == Process::State::alive || holder.state == Process::State::stopped) {
    holder.status = family::status_of_zombie(holder.real_id);
    holder.state = Process::State::ended;
    holder.next = kernel::EventKey::never();
    holder.listens_to = 0;
    holder.is_rung = holder.waits_outside = false;
    --family_->alive;
  }
  family_->holder = 0;
  own().has_turn = 1;
}

// What the system does at a process's end must have happened when another continues.
void ProcessHost::await_end_of_leaving() {
  constexpr timespec soon{0, 20'000};
  while (family_->leaving != 0 && family::is_running(family_->leaving)) sleep_really(soon);
  family_->leaving = 0;
}

std::uint64_t ProcessHost::digest() const {
  std::uint64_t sum = family_->digest_of_ended;
  for (const Process& process : family::entries_of(*family_))
    if (process.state != Process::State::none) sum += family::share_of_digest(process.id, process.digest);
  return sum;
}

}  // namespace waitpoint::posix
