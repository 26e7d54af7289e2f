// SPDX-License-Identifier: BSD-3-Clause
#include "tools/view/server/web_server.hpp"

#include <boost/asio/ip/tcp.hpp>
#include <map>

#include "core/error.hpp"
#include "tools/view/server/event_loop.hpp"
#include "tools/view/server/request_rules.hpp"
#include "tools/view/server/web_socket.hpp"

namespace waitpoint::tools::view {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using boost::system::error_code;
using Tcp = asio::ip::tcp;

namespace {

constexpr std::size_t connections_max = 64, clients_max = 16;
constexpr std::size_t request_bytes_max = 8'192;
constexpr auto request_time = std::chrono::seconds(20);

}  // namespace

struct WebServer::Implementation {
  /// A connection that has not become a WebSocket.
  struct Connection : std::enable_shared_from_this<Connection> {
    Connection(Implementation& all, Tcp::socket socket) : all(all), stream(std::move(socket)) { ++all.connections; }
    ~Connection() { --all.connections; }

    void read() {
      parser.header_limit(request_bytes_max);
      parser.body_limit(request_bytes_max);
      stream.expires_after(request_time);
      http::async_read(stream, buffer, parser, [self = shared_from_this()](error_code error, std::size_t) {
        if (!error) self->respond();
      });
    }

    void respond() {
      const Request& request = parser.get();
      if (!beast::websocket::is_upgrade(request) || RequestRules::path(request) != SocketService::path)
        return write(all.rules.answer(request));
      if (auto refusal = all.rules.refusal(request)) return write(std::move(*refusal));
      if (all.clients.size() >= clients_max)
        return write(RequestRules::error(request, http::status::service_unavailable, "there are too many viewers\n"));
      stream.expires_never();
      all.add(std::move(stream))->accept(request);
    }

    void write(Response answer) {
      response = std::move(answer);
      http::async_write(stream, response, [self = shared_from_this()](error_code, std::size_t) {
        error_code ignored;
        self->stream.socket().shutdown(Tcp::socket::shutdown_send, ignored);
      });
    }

    Implementation& all;
    beast::tcp_stream stream;
    beast::flat_buffer buffer;
    http::request_parser<http::string_body> parser;
    Response response;
  };

  std::shared_ptr<WebSocket> add(beast::tcp_stream stream) {
    const ClientNumber number = ++last_number;
    WebSocket::Events events;
    events.opened = [this, number] { service.opened(number); };
    events.received = [this, number](const std::string& text) {
      if (service.received) service.received(number, text);
    };
    events.ended = [this, number](bool was_open) {
      clients.erase(number);
      if (was_open) service.closed(number);
    };
    auto socket = std::make_shared<WebSocket>(std::move(stream), std::move(events));
    clients[number] = socket;
    return socket;
  }

  void accept() {
    acceptor.async_accept([this](error_code error, Tcp::socket socket) {
      if (error == asio::error::operation_aborted) return;
      if (!error && connections < connections_max) std::make_shared<Connection>(*this, std::move(socket))->read();
      accept();
    });
  }

  SocketService service;  // outlives the loop's sockets
  RequestRules rules;
  std::size_t connections = 0;
  EventLoop loop;
  Tcp::acceptor acceptor{loop.context()};
  ClientNumber last_number = 0;
  std::map<ClientNumber, std::shared_ptr<WebSocket>> clients;
};

WebServer::WebServer(const WebServerOptions& options, SocketService service, const std::string& option)
    : all_(std::make_unique<Implementation>()) {
  all_->service = std::move(service);
  try {
    const Tcp::endpoint endpoint(asio::ip::make_address(options.address), options.port);
    all_->acceptor.open(endpoint.protocol());
    all_->acceptor.set_option(asio::socket_base::reuse_address(true));
    all_->acceptor.bind(endpoint);
    all_->acceptor.listen();
  } catch (const boost::system::system_error& failure) {
    throw BadInput(option, "cannot listen at " + options.address + ":" + std::to_string(options.port) + ": " +
                               failure.code().message());
  }
  const std::string port = std::to_string(all_->acceptor.local_endpoint().port());
  const bool is_v6 = all_->acceptor.local_endpoint().address().is_v6();
  all_->rules = {(is_v6 ? "[" + options.address + "]" : options.address) + ":" + port, "localhost:" + port,
                 all_->acceptor.local_endpoint().address().is_unspecified(), options.token, options.page};
  all_->accept();
}

WebServer::~WebServer() = default;

std::string WebServer::url() const { return "http://" + all_->rules.host + "/?token=" + all_->rules.token; }

void WebServer::set_page(std::string_view page) { all_->rules.page = page; }

void WebServer::send(ClientNumber client, std::string text) {
  if (const auto found = all_->clients.find(client); found != all_->clients.end()) found->second->send(std::move(text));
}

std::size_t WebServer::queued(ClientNumber client) const {
  const auto found = all_->clients.find(client);
  return found != all_->clients.end() ? found->second->queued() : 0;
}

void WebServer::close(ClientNumber client) {
  if (const auto found = all_->clients.find(client); found != all_->clients.end()) found->second->end();
}

void WebServer::watch(int descriptor, std::function<void()> ready) { all_->loop.watch(descriptor, std::move(ready)); }

void WebServer::forget(int descriptor) { all_->loop.forget(descriptor); }

void WebServer::repeat(int milliseconds, std::function<void()> action) {
  all_->loop.repeat(milliseconds, std::move(action));
}

void WebServer::run() { all_->loop.run(); }

void WebServer::stop() { all_->loop.stop(); }

}  // namespace waitpoint::tools::view
