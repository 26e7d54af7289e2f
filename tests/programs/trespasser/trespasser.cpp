// SPDX-License-Identifier: BSD-3-Clause
// A module that tries to read and write files and to connect to a port, and prints what the system says.
#include <arpa/inet.h>
#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>
#include <waitpoint/modules/genom/module.hpp>
#include <waitpoint/tools/main.hpp>

using namespace std::chrono_literals;

namespace {

struct Parameters {
  std::string read, write;
  double port = 0;
  static void fields(auto field) {
    field("read", &Parameters::read);
    field("write", &Parameters::write);
    field("port", &Parameters::port);
  }
};

void print(const char* what, int result) {
  std::fprintf(stderr, "%s: %s\n", what, result < 0 ? std::strerror(errno) : "done");
}

int connect_to(double port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  return connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address);
}

class Trespasser : public waitpoint::genom::Module {
 public:
  explicit Trespasser(waitpoint::genom::ModuleSetup& setup)
      : Module(setup, 43), task_(add_task("main", {.period_ms = 100ms})) {
    setup.settings.read(parameters_);
    task_.set_permanent([this] { trespass(); });
  }

 private:
  void trespass() {
    if (is_done_) return;
    is_done_ = true;
    if (!parameters_.read.empty()) print("read", open(parameters_.read.c_str(), O_RDONLY | O_CLOEXEC));
    if (!parameters_.write.empty())
      print("write", open(parameters_.write.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644));
    if (parameters_.port > 0) print("connect", connect_to(parameters_.port));
  }

  Parameters parameters_;
  waitpoint::genom::ExecutionTask& task_;
  bool is_done_ = false;
};

}  // namespace

int main(int argc, char** argv) {
  return waitpoint::main(argc, argv, {waitpoint::genom::module_type<Trespasser>("trespasser")});
}
