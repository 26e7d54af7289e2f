// SPDX-License-Identifier: BSD-3-Clause
// A module that ends the process, or holds up the run: all ways in which `waitpoint run` must still say what happened.
// The setting `end` selects one, `place` the place: the codel at 0.3 s, a thread of the operating system that it
// starts, one that the module's destructor starts, or the program's static destructors and a thread that they start.
#include <semaphore.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <threads.h>
#include <unistd.h>

#include <cassert>
#include <csignal>
#include <cstdlib>
#include <map>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <waitpoint/fibers/sync/condition_variable.hpp>
#include <waitpoint/fibers/sync/mutex.hpp>
#include <waitpoint/modules/genom/module.hpp>
#include <waitpoint/tools/main.hpp>

using namespace std::chrono_literals;

namespace {

volatile int zero = 0;
int* volatile nowhere = reinterpret_cast<int*>(64);
std::mutex of_the_system;

[[gnu::noinline]] void fail_an_assertion() { assert(zero != 0); }
[[gnu::noinline]] void divide() { zero = 100 / zero; }
[[gnu::noinline]] void write_nowhere() { *nowhere = 1; }
[[gnu::noinline]] void throw_out_of_noexcept() noexcept { throw std::logic_error("nobody catches this"); }
[[gnu::noinline]] void call_nothing() { reinterpret_cast<void (*)()>(nowhere)(); }
[[gnu::noinline]] void spin() {
  while (zero == 0) {
  }
}
[[gnu::noinline]] void free_twice() {
  void* volatile block = std::malloc(2000);
  void* volatile next = std::malloc(2000);
  std::free(block);
  std::free(next);
  std::free(next);
}

[[gnu::noinline]] void end_the_child_of_a_fork() {
  const pid_t child = fork();
  if (child == 0) _exit(0);
  waitpid(child, nullptr, 0);
  abort();
}
[[gnu::noinline]] void throw_in_vain() {
  struct Thrown : std::exception {
    const char* what() const noexcept override { return nullptr; }
  };
  throw Thrown();
}
[[gnu::noinline]] void throw_at_a_copy() {
  struct Thrown {
    Thrown() = default;
    Thrown(const Thrown&) { throw std::runtime_error("out of a copy"); }
  };
  const Thrown thrown;
  throw thrown;
}
[[gnu::noinline]] void throw_in_a_handler_of_terminate() {
  std::set_terminate([] { throw 2; });
  throw_out_of_noexcept();
}
[[gnu::noinline]] int overrun_the_stack(int depth) {
  volatile char frame[2048];
  frame[0] = static_cast<char>(depth);
  return depth > 0 ? overrun_the_stack(depth + 1) + frame[0] : 0;
}
void disable_the_signal_stack() {
  stack_t none{};
  none.ss_flags = SS_DISABLE;
  sigaltstack(&none, nullptr);
}
void block_all_signals() {
  sigset_t all;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, nullptr);
}
pthread_t main_thread = pthread_self();

[[gnu::noinline]] void fork_once() {
  const pid_t child = fork();
  if (child == 0) _exit(0);
  waitpid(child, nullptr, 0);
}
/// The child goes on with the run, as a copy of this process; its exit status must be 1.
[[gnu::noinline]] void fork_a_child_that_returns() {
  const pid_t child = fork();
  int status = 0;
  if (child != 0 && (waitpid(child, &status, 0) != child || status != 1 << 8)) abort();
}
[[gnu::noinline]] void fork_a_child_that_crashes() {
  const pid_t child = fork();
  if (child == 0) write_nowhere();
  waitpid(child, nullptr, 0);
}
[[gnu::noinline]] void vfork_once() {
  const pid_t child = vfork();
  if (child == 0) _exit(0);
  waitpid(child, nullptr, 0);
}
[[gnu::noinline]] void lock_for_a_while() {
  static std::timed_mutex mutex;
  mutex.lock();
  if (!mutex.try_lock_for(1ms)) mutex.unlock();
}
[[gnu::noinline]] void wait_for_a_lost_notification() {
  static waitpoint::mutex mutex("lost");
  static waitpoint::condition_variable condition("data ready");
  std::unique_lock lock(mutex);
  condition.wait(lock);
}
[[gnu::noinline]] void wait_for_itself() {
  static waitpoint::mutex mutex("own");
  mutex.lock();
  mutex.lock();
}

// The setting comes too late for it.
struct EarlyThread {
  EarlyThread() {
    if (std::getenv("EARLY_THREAD") != nullptr) std::thread([] {}).detach();
  }
} early_thread;

const std::map<std::string, void (*)()> ways = {
    {"abort", [] { std::abort(); }},
    {"assert", fail_an_assertion},
    {"terminate", throw_out_of_noexcept},
    {"illegal", [] { __builtin_trap(); }},
    {"division", divide},
    {"address", write_nowhere},
    {"heap", free_twice},
    {"exit", [] { std::exit(0); }},
    {"_exit", [] { _exit(0); }},
    {"quick_exit", [] { std::quick_exit(0); }},
    {"exit_group", [] { syscall(SYS_exit_group, 0); }},
    {"execl", [] { execl("/bin/true", "true", nullptr); }},
    {"execlp", [] { execlp("true", "true", nullptr); }},
    {"execle", [] { execle("/bin/true", "true", nullptr, environ); }},
    {"daemon", [] { (void)daemon(1, 1); }},
    {"exit in a thread", [] { std::thread([] { std::exit(0); }).join(); }},
    {"pthread_exit", [] { pthread_exit(nullptr); }},
    {"alarm", [] { raise(SIGALRM); }},
    {"default", [] { signal(SIGSEGV, SIG_DFL), write_nowhere(); }},
    {"blocked",
     [] {
       block_all_signals();
       spin();
     }},
    {"system", [] { (void)std::system("true"); }},
    {"vfork", [] { vfork_once(); }},
    {"timed", [] { lock_for_a_while(); }},
    {"call", call_nothing},
    {"raise", [] { raise(SIGSEGV); }},
    {"trap", [] { raise(SIGTRAP); }},
    {"die in a thread", [] { std::thread([] { write_nowhere(); }).join(); }},
    {"throw a number", [] { throw 42; }},
    {"exception", [] { throw std::runtime_error("out of the codel"); }},
    {"loop", spin},
    {"thread", [] { std::thread([] {}).detach(); }},
    {"fork", fork_once},
    {"fork returns", fork_a_child_that_returns},
    {"fork crashes", fork_a_child_that_crashes},
    {"sleep", [] { std::this_thread::sleep_for(1ms); }},
    {"lost", wait_for_a_lost_notification},
    {"deadlock", wait_for_itself},
    {"block",
     [] {
       sem_t taken;
       sem_init(&taken, 0, 0);
       sem_wait(&taken);
     }},
    {"lock",
     [] {
       of_the_system.lock();
       of_the_system.lock();
     }},
};

const std::map<std::string, void (*)()> ways_by_calls_and_signals = {
    {"_Exit", [] { std::_Exit(0); }},
    {"exit of the system", [] { syscall(SYS_exit, 0); }},
    {"thrd_exit", [] { thrd_exit(0); }},
    {"cancel itself", [] { pthread_cancel(pthread_self()), pthread_testcancel(); }},
    {"cancel the run", [] { pthread_cancel(main_thread); }},
    {"kill", [] { kill(getpid(), SIGKILL); }},
    {"raise SIGKILL", [] { raise(SIGKILL); }},
    {"pthread_kill", [] { pthread_kill(pthread_self(), SIGKILL); }},
    {"tgkill", [] { tgkill(getpid(), gettid(), SIGKILL); }},
    {"system call kill", [] { syscall(SYS_kill, getpid(), SIGKILL); }},
    {"sigqueue", [] { sigqueue(getpid(), SIGKILL, {}); }},
    {"pipe", [] { signal(SIGPIPE, SIG_DFL), raise(SIGPIPE); }},
    {"real-time signal", [] { raise(SIGRTMAX); }},
    {"power", [] { raise(SIGPWR); }},
    {"no signal stack", [] { disable_the_signal_stack(), overrun_the_stack(1); }},
    {"blocked address", [] { block_all_signals(), write_nowhere(); }},
    {"throw in vain", throw_in_vain},
    {"throw at a copy", throw_at_a_copy},
    {"throw in terminate", throw_in_a_handler_of_terminate},
    {"fork and abort", end_the_child_of_a_fork},
};

void die(const std::string& way) {
  for (const auto& each : {ways, ways_by_calls_and_signals})
    if (const auto found = each.find(way); found != each.end()) found->second();
}

void start_to_die(const std::string& way) {
  std::thread([way] { die(way); }).detach();
}

struct Parameters {
  std::string end = "none", place = "codel";
  static void fields(auto field) {
    field("end", &Parameters::end);
    field("place", &Parameters::place);
  }
};

struct AtExit {
  ~AtExit() {
    if (place == "static destructor") die(way);
    if (place == "thread of a static destructor") std::thread([this] { die(way); }).join();
  }
  std::string place, way;
} at_exit;

class Mortal : public waitpoint::genom::Module {
 public:
  explicit Mortal(waitpoint::genom::ModuleSetup& setup)
      : Module(setup, 42), task_(add_task("main", {.period_ms = 100ms})) {
    setup.settings.read(parameters_);
    if (parameters_.end == "constructor throws") throw std::runtime_error("no such device");
    if (parameters_.end == "constructor throws a number") throw 42;
    if (parameters_.end == "constructor crashes") write_nowhere();
    if (parameters_.end == "constructor exits") std::exit(0);
    if (parameters_.end == "constructor spins") spin();
    if (parameters_.end == "constructor forks") fork_once();
    task_.set_permanent([this] {
      if (++periods_ != 3) return;
      if (parameters_.place == "codel") die(parameters_.end);
      if (parameters_.place == "thread") start_to_die(parameters_.end);
    });
    at_exit.place = parameters_.place;
    at_exit.way = parameters_.end;
  }
  ~Mortal() {
    if (parameters_.end == "destructor crashes") write_nowhere();
    if (parameters_.place == "destructor") die(parameters_.end);
    if (parameters_.place == "thread of a destructor") {
      start_to_die(parameters_.end);
      std::this_thread::sleep_for(100ms);
    }
  }

 private:
  Parameters parameters_;
  waitpoint::genom::ExecutionTask& task_;
  int periods_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  return waitpoint::main(argc, argv, {waitpoint::genom::module_type<Mortal>("mortal")});
}
