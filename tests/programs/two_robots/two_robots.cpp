// SPDX-License-Identifier: BSD-3-Clause
// Robots that communicate over a medium: each sends its position by datagrams, which may be lost, and writes a log to
// the other robot's mailbox, by letters, which are not lost. The paper's modules drive them.
#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <waitpoint/fibers/io/datagram_socket.hpp>
#include <waitpoint/fibers/io/mailbox_sender.hpp>
#include <waitpoint/modules/genom/module.hpp>
#include <waitpoint/modules/posters/position.hpp>
#include <waitpoint/tools/main.hpp>

using namespace std::chrono_literals;
using waitpoint::Duration;
using waitpoint::Time;
namespace io = waitpoint::io;

/// The content of the poster radio.mate about the other robot.
struct Mate {
  double x_m = 0, y_m = 0;
  Time date;                    ///< of its last position
  std::uint32_t positions = 0;  ///< received so far
  std::uint32_t entries = 0;    ///< of its log, received so far
  static void fields(auto field) {
    field("x_m", &Mate::x_m);
    field("y_m", &Mate::y_m);
    field("date", &Mate::date);
    field("positions", &Mate::positions);
    field("entries", &Mate::entries);
  }
};

/// An entry of a robot's log.
struct LogEntry {
  std::uint32_t number = 0;
  static void fields(auto field) { field("number", &LogEntry::number); }
};

/// The module's settings in a scenario.
struct RadioParameters {
  std::string mate;              ///< the other robot
  Duration silence_ms = 1500ms;  ///< contact is lost after this time without a position
  static void fields(auto field) {
    field("mate", &RadioParameters::mate);
    field("silence_ms", &RadioParameters::silence_ms);
  }
};

class Radio : public waitpoint::genom::Module {
 public:
  explicit Radio(waitpoint::genom::ModuleSetup& setup)
      : Module(setup, 44),
        network_(*setup.network),
        task_(add_task("main", {.period_ms = 200ms, .cost_us = 50us})),
        position_(read_poster<waitpoint::posters::FusedPosition>("pom.position")) {
    setup.settings.read(parameters_);
    add_poster<Mate>("mate", task_, &mate_);  // written at the end of every period
    task_.set_start([this] { open(); });
    task_.set_permanent([this] {
      tell_position();
      write_log();
      listen();
    });
  }

 private:
  struct Message {
    double x_m, y_m;
    std::int64_t date_ns;
  };

  void open() {
    socket_ = io::datagram_socket(network_);
    socket_.bind("position");
    log_.emplace(64);
    log_->bind(network_, "log");
    to_log_.emplace(network_, parameters_.mate + ":log");
  }

  void tell_position() {
    waitpoint::posters::FusedPosition fused;
    if (position_.read(fused) != waitpoint::genom::PosterStatus::ok) return;
    const auto& here = fused.position;
    const Message message{here.pose.x, here.pose.y, here.date.ns()};
    const io::Status status = socket_.send_to(parameters_.mate + ":position", std::as_bytes(std::span(&message, 1)));
    if (status != io::Status::ok && !std::exchange(complained_, true))
      say(std::string("cannot send: ") + to_string(status));
  }

  // Every fifth period; entries that the medium delays are tried again.
  void write_log() {
    if (++periods_ % 5 == 0) ++written_;
    while (sent_ < written_ && to_log_->try_send({sent_ + 1}) == io::Status::ok) ++sent_;
  }

  void listen() {
    Message message{};
    while (socket_.receive(std::as_writable_bytes(std::span(&message, 1)), io::no_wait)) {
      mate_ = {message.x_m, message.y_m, Time::from_ns(message.date_ns), mate_.positions + 1, mate_.entries};
      heard_ = waitpoint::threads::now();
      if (!std::exchange(contact_, true)) say("hears " + parameters_.mate);
    }
    while (const auto entry = log_->try_receive()) {
      if (entry.value().number != ++mate_.entries) say("an entry is missing");
    }
    if (contact_ && waitpoint::threads::now() - heard_ > parameters_.silence_ms) {
      contact_ = false;
      say("has lost " + parameters_.mate);
    }
  }

  void say(const std::string& text) {
    std::printf("%5.1f s  %s %s (%u positions, %u log entries)\n", waitpoint::threads::now().since_start().seconds(),
                network_.own_node()->name().c_str(), text.c_str(), mate_.positions, mate_.entries);
  }

  io::Network& network_;
  RadioParameters parameters_;
  waitpoint::genom::ExecutionTask& task_;
  waitpoint::genom::PosterLink<waitpoint::posters::FusedPosition>& position_;
  io::datagram_socket socket_;
  std::optional<io::mailbox<LogEntry>> log_;            // the mate's
  std::optional<io::mailbox_sender<LogEntry>> to_log_;  // this robot's, at the mate's
  Mate mate_;
  Time heard_;
  bool contact_ = false, complained_ = false;
  std::uint32_t periods_ = 0, written_ = 0, sent_ = 0;
};

int main(int argc, char** argv) { return waitpoint::main(argc, argv, {waitpoint::genom::module_type<Radio>("radio")}); }
