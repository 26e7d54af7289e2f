// SPDX-License-Identifier: BSD-3-Clause
// Paho's client for MQTT in C++, issues 356 and 481: a callback is set while a message is sent.
#include <mqtt/async_client.h>

#include <thread>

#include "tests/found_again/mqtt_broker.hpp"

int main() {
  const int listener = listen_at(9894);
  std::thread broker([&] { accept_client(listener); });
  mqtt::async_client client("tcp://127.0.0.1:9894", "client");
  mqtt::callback callback;
  client.connect()->wait();
  const auto delivery = client.publish("topic", "text", 4, 0, false);
  client.set_callback(callback);
  delivery->wait();
  broker.join();
}
