// SPDX-License-Identifier: BSD-3-Clause
// A program with two modules of its own: one blinks a lamp on request, the other sends the request and watches.
#include <cstdio>
#include <waitpoint/modules/genom/client.hpp>
#include <waitpoint/modules/genom/module.hpp>
#include <waitpoint/tools/main.hpp>

using namespace std::chrono_literals;
using waitpoint::Duration;
using waitpoint::genom::State;

/// The type of the poster blinker.lamp.
struct Lamp {
  bool lit = false;
  std::uint32_t flashes = 0;  ///< so far
  static void fields(auto field) {
    field("lit", &Lamp::lit);
    field("flashes", &Lamp::flashes);
  }
};

/// Input of the request Blink.
struct BlinkInput {
  std::uint32_t flashes = 1;
  static void fields(auto field) { field("flashes", &BlinkInput::flashes); }
};

class Blinker : public waitpoint::genom::Module {
 public:
  explicit Blinker(waitpoint::genom::ModuleSetup& setup)
      : Module(setup, 42), task_(add_task("main", {.period_ms = 250ms, .cost_us = 20us})) {
    add_poster<Lamp>("lamp", task_, &lamp_);  // written at the end of every period
    // One codel is called per period, until the activity's state is ETHER. A new Blink interrupts the running one.
    add_activity<BlinkInput>("Blink", task_,
                             {.start =
                                  [this](auto& activity) {
                                    last_ = lamp_.flashes + activity.input.flashes;
                                    return activity.input.flashes > 0 ? State::exec : State::ether;
                                  },
                              .exec =
                                  [this](auto&) {
                                    lamp_.lit = !lamp_.lit;
                                    if (lamp_.lit) ++lamp_.flashes;
                                    return lamp_.lit || lamp_.flashes < last_ ? State::exec : State::ether;
                                  },
                              .inter =
                                  [this](auto&) {
                                    lamp_.lit = false;
                                    return State::ether;
                                  }},
                             {"Blink"});
  }

 private:
  Lamp lamp_;
  std::uint32_t last_ = 0;
  waitpoint::genom::ExecutionTask& task_;
};

/// The module's settings in a scenario.
struct WatchmanParameters {
  std::uint32_t flashes = 3;  ///< number requested
  static void fields(auto field) { field("flashes", &WatchmanParameters::flashes); }
};

class Watchman : public waitpoint::genom::Module {
 public:
  explicit Watchman(waitpoint::genom::ModuleSetup& setup)
      : Module(setup, 43),
        client_(setup.names, setup.name),
        task_(add_task("main", {.period_ms = 100ms, .cost_us = 50us})),
        lamp_(read_poster<Lamp>("blinker.lamp")) {
    setup.settings.read(parameters_);
    task_.set_permanent([this] { watch(); });
  }

 private:
  void watch() {
    if (!asked_) {
      asked_ = true;
      client_.send("blinker", "Blink", BlinkInput{parameters_.flashes});
    }
    Lamp lamp;
    waitpoint::Time date;
    if (lamp_.read(lamp, &date) == waitpoint::genom::PosterStatus::ok && lamp.lit != lit_) {
      lit_ = lamp.lit;
      std::printf("%s s: the lamp is %s\n", waitpoint::to_string(date).c_str(), lit_ ? "on" : "off");
    }
    while (const auto reply = client_.receive(Duration())) {
      std::printf("%s s: %s reply: %s\n", waitpoint::to_string(waitpoint::threads::now()).c_str(),
                  reply->final ? "final" : "intermediate", waitpoint::genom::name(reply->report));
    }
  }

  WatchmanParameters parameters_;
  waitpoint::genom::Client client_;
  waitpoint::genom::ExecutionTask& task_;
  waitpoint::genom::PosterLink<Lamp>& lamp_;
  bool asked_ = false;
  bool lit_ = false;
};

int main(int argc, char** argv) {
  using waitpoint::genom::module_type;
  return waitpoint::main(argc, argv, {module_type<Blinker>("blinker"), module_type<Watchman>("watchman")});
}
