// SPDX-License-Identifier: BSD-3-Clause
// A module that writes a value to a poster every 100 ms, from a source that modules must not use: all sources of
// nondeterminism that a self-check (`run SCENARIO --verify`) must find. The setting `source` selects one. Others do not
// end in another environment.
#include <dirent.h>
#include <pthread.h>
#include <sys/random.h>
#include <unistd.h>
#include <x86intrin.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <unordered_set>
#include <vector>
#include <waitpoint/modules/genom/module.hpp>
#include <waitpoint/tools/main.hpp>

using namespace std::chrono_literals;

namespace {

using Value = std::uint64_t;

struct Shown {
  Value value = 0;
  static void fields(auto field) { field("value", &Shown::value); }
};

struct Parameters {
  std::string source = "none";
  static void fields(auto field) { field("source", &Parameters::source); }
};

/// A hash that depends on the order.
Value mixed(Value sum, Value next) { return (sum ^ next) * 0x100000001B3; }

/// Heap blocks with consecutive numbers.
std::vector<std::unique_ptr<Value>> things() {
  std::vector<std::unique_ptr<Value>> result;
  for (Value i = 0; i < 200; ++i) result.push_back(std::make_unique<Value>(i));
  return result;
}

template <class Set>
Value order_of(const std::vector<std::unique_ptr<Value>>& all) {
  Set set;
  for (const auto& thing : all) set.insert(thing.get());
  Value sum = 0;
  for (const Value* thing : set) sum = mixed(sum, *thing);
  return sum;
}

Value none() { return 42; }

Value wall_clock() {  // to the hour: two consecutive runs see the same value
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return static_cast<Value>(std::chrono::floor<std::chrono::hours>(now).count());
}

Value time_stamp() { return __rdtsc(); }

Value system_random() {
  Value value = 0;
  if (getrandom(&value, sizeof value, 0) != sizeof value) throw std::runtime_error("getrandom");
  return value;
}

Value pointer_order() { return order_of<std::set<const Value*>>(things()); }

Value hash_order() { return order_of<std::unordered_set<const Value*>>(things()); }

/// The sum of uninitialised memory.
Value sum_of(const volatile unsigned char* bytes, std::size_t size) {
  Value sum = 0;
  for (std::size_t i = 0; i < size; ++i) sum = mixed(sum, bytes[i]);
  return sum;
}

Value uninitialised() {
  const std::unique_ptr<unsigned char[]> bytes(new unsigned char[600]);
  return sum_of(bytes.get(), 600);
}

Value uninitialised_stack() {
  volatile unsigned char bytes[600];
  return sum_of(bytes, sizeof bytes);
}

Value survivor() {
  static Value calls = 0;
  return ++calls;
}

Value process_id() { return static_cast<Value>(getpid()); }

Value directory_order() {
  DIR* const directory = opendir(".");
  if (directory == nullptr) throw std::runtime_error("opendir");
  Value sum = 0;
  while (const dirent* entry = readdir(directory))
    for (const char* at = entry->d_name; *at != '\0'; ++at) sum = mixed(sum, static_cast<unsigned char>(*at));
  closedir(directory);
  return sum;
}

Value heap_address() { return reinterpret_cast<Value>(std::make_unique<Value>(1).get()); }

/// Counts during its lifetime, on a thread outside the simulation.
class Counter {
 public:
  Counter()
      : thread_([this] {
          pthread_setname_np(pthread_self(), "hidden");
          while (!over_) ++count_;
        }) {}
  ~Counter() {
    over_ = true;
    thread_.join();
  }
  Value count() const {
    const Value start = count_;
    while (count_ == start) std::this_thread::yield();
    return count_;
  }

 private:
  std::atomic<bool> over_{false};
  std::atomic<Value> count_{0};
  std::thread thread_;
};

Value environment() {
  Value sum = 0;
  const char* const user = std::getenv("USER");
  for (const char* at = user == nullptr ? "" : user; *at != '\0'; ++at)
    sum = mixed(sum, static_cast<unsigned char>(*at));
  return sum;
}

/// True in the perturbed process, by its environment.
bool elsewhere() {
  const char* const user = std::getenv("USER");
  return user != nullptr && (std::string(user) == "somebody" || std::string(user) == "another");
}

Value crash() {
  if (elsewhere()) std::raise(SIGILL);
  return none();
}

Value endless_loop() {
  while (elsewhere()) sleep(1);
  return none();
}

Value exception() {
  if (elsewhere()) throw std::runtime_error("the user is unknown here");
  return none();
}

const std::map<std::string, Value (*)()> sources = {
    {"none", none},
    {"wall_clock", wall_clock},
    {"rdtsc", time_stamp},
    {"getrandom", system_random},
    {"pointer_order", pointer_order},
    {"hash_order", hash_order},
    {"uninitialised", uninitialised},
    {"static", survivor},
    {"getpid", process_id},
    {"directory_order", directory_order},
    {"heap_address", heap_address},
    {"environment", environment},
    {"uninitialised_stack", uninitialised_stack},
    {"crash", crash},
    {"endless_loop", endless_loop},
    {"exception", exception},
};

class Unrepeatable : public waitpoint::genom::Module {
 public:
  explicit Unrepeatable(waitpoint::genom::ModuleSetup& setup)
      : Module(setup, 44),
        task_(add_task("main", {.period_ms = 100ms, .cost_us = 50us})),
        shown_(add_poster<Shown>("shown", task_)) {
    Parameters parameters;
    setup.settings.read(parameters);
    if (parameters.source == "hidden_thread") {
      counter_ = std::make_unique<Counter>();
    } else {
      source_ = sources.at(parameters.source);
    }
    task_.set_permanent([this] { shown_.write({counter_ ? counter_->count() : source_()}); });
  }

 private:
  waitpoint::genom::ExecutionTask& task_;
  waitpoint::genom::OutputPoster<Shown>& shown_;
  std::unique_ptr<Counter> counter_;
  Value (*source_)() = none;
};

}  // namespace

int main(int argc, char** argv) {
  return waitpoint::main(argc, argv, {waitpoint::genom::module_type<Unrepeatable>("unrepeatable")});
}
