// SPDX-License-Identifier: BSD-3-Clause
// Poco (docs/found.md): an activity is destroyed while its method returns.
#include <Poco/Activity.h>

#include <memory>

class Worker {
 public:
  Worker() : activity(this, &Worker::work) {}

  Poco::Activity<Worker> activity;

 private:
  void work() {}
};

int main() {
  auto worker = std::make_unique<Worker>();
  worker->activity.start();
  worker.reset();
}
