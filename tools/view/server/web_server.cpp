// SPDX-License-Identifier: BSD-3-Clause
#include "tools/view/server/web_server.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <deque>
#include <list>
#include <map>

#include "core/error.hpp"

namespace waitpoint::tools::view {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using boost::system::error_code;
using Tcp = asio::ip::tcp;

namespace {

constexpr std::size_t connections_max = 64, clients_max = 16;
constexpr std::size_t request_bytes_max = 8'192, text_bytes_max = 65'536;
// A client that has so much to take is dead or far too slow.
constexpr std::size_t queued_bytes_max = 256 << 20;
constexpr auto request_time = std::chrono::seconds(20);

/// What requests must have, and the answers that all share.
struct Rules {
  std::string host, local_host;  ///< "127.0.0.1:1234", "localhost:1234"
  std::string token;
  std::string_view page;

  bool knows(std::string_view text) const { return text == host || text == local_host; }
  /// The request is for `path`, with the token.
  bool is_for(std::string_view target, std::string_view path) const {
    const std::string expected = "token=" + token;
    const std::size_t query = target.find('?');
    return target.substr(0, query) == path && query != std::string_view::npos && target.substr(query + 1) == expected;
  }
};

using Request = http::request<http::string_body>;
using Response = http::response<http::string_body>;

Response answer(const Rules& rules, const Request& request) {
  Response response(http::status::ok, request.version());
  response.set(http::field::cache_control, "no-store");
  response.set("X-Content-Type-Options", "nosniff");
  response.set("Referrer-Policy", "no-referrer");
  response.set(http::field::content_type, "text/plain; charset=utf-8");
  response.keep_alive(false);
  const std::string_view target(request.target().data(), request.target().size());
  const std::string_view path = target.substr(0, target.find('?'));
  const auto refuse = [&](http::status status, const char* text) {
    response.result(status);
    response.body() = text;
  };
  if (request.method() != http::verb::get && request.method() != http::verb::head)
    refuse(http::status::method_not_allowed, "expected GET\n");
  else if (!rules.knows({request[http::field::host].data(), request[http::field::host].size()}))
    refuse(http::status::forbidden, "this address is not the server's own\n");
  else if (path != "/")
    refuse(http::status::not_found, "there is only one page\n");
  else if (!rules.is_for(target, "/"))
    refuse(http::status::forbidden, "expected the address with the token that waitpoint printed\n");
  else {
    response.set(http::field::content_type, "text/html; charset=utf-8");
    response.set("Content-Security-Policy",
                 "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data:; "
                 "connect-src 'self' ws://" +
                     rules.host + " ws://" + rules.local_host +
                     "; base-uri 'none'; form-action 'none'; "
                     "frame-ancestors 'none'");
    response.body() = rules.page;
  }
  response.prepare_payload();
  if (request.method() == http::verb::head) response.body().clear();
  return response;
}

}  // namespace

struct WebServer::Implementation {
  /// A WebSocket.
  struct Client : std::enable_shared_from_this<Client> {
    Client(Implementation& all, ClientNumber number, beast::tcp_stream stream)
        : all(all), number(number), socket(std::move(stream)) {}

    void accept(const Request& request) {
      socket.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
      socket.read_message_max(text_bytes_max);
      socket.auto_fragment(false);
      socket.async_accept(request, [self = shared_from_this()](error_code error) {
        if (error) return self->end();
        self->is_open = true;
        if (self->all.server.opened) self->all.server.opened(self->number);
        self->read();
      });
    }

    void read() {
      socket.async_read(buffer, [self = shared_from_this()](error_code error, std::size_t) {
        if (error) return self->end();
        std::string text = beast::buffers_to_string(self->buffer.data());
        self->buffer.consume(self->buffer.size());
        if (self->all.server.received) self->all.server.received(self->number, std::move(text));
        if (!self->has_ended) self->read();
      });
    }

    void send(std::string text) {
      if (!is_open || has_ended) return;
      queued += text.size();
      if (queued > queued_bytes_max) return end();
      texts.push_back(std::move(text));
      if (texts.size() == 1) write();
    }

    void write() {
      socket.text(true);
      socket.async_write(asio::buffer(texts.front()), [self = shared_from_this()](error_code error, std::size_t) {
        if (error) return self->end();
        self->queued -= self->texts.front().size();
        self->texts.pop_front();
        if (!self->texts.empty() && !self->has_ended) self->write();
      });
    }

    void end() {
      if (std::exchange(has_ended, true)) return;
      const std::shared_ptr<Client> self = shared_from_this();
      all.clients.erase(number);
      beast::get_lowest_layer(socket).close();
      if (is_open && all.server.closed) all.server.closed(number);
    }

    Implementation& all;
    ClientNumber number;
    websocket::stream<beast::tcp_stream> socket;
    beast::flat_buffer buffer;
    std::deque<std::string> texts;  // the first is being sent
    std::size_t queued = 0;
    bool is_open = false, has_ended = false;
  };

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
      if (websocket::is_upgrade(request) && may_upgrade(request)) {
        stream.expires_never();
        all.add(std::move(stream))->accept(request);
        return;
      }
      response = answer(all.rules, request);
      http::async_write(stream, response, [self = shared_from_this()](error_code, std::size_t) {
        error_code ignored;
        self->stream.socket().shutdown(Tcp::socket::shutdown_send, ignored);
      });
    }

    bool may_upgrade(const Request& request) const {
      const std::string_view origin(request[http::field::origin].data(), request[http::field::origin].size());
      const std::string_view host(request[http::field::host].data(), request[http::field::host].size());
      const bool is_own = origin.empty() || (origin.substr(0, 7) == "http://" && all.rules.knows(origin.substr(7)));
      return is_own && all.rules.knows(host) && all.clients.size() < clients_max &&
             all.rules.is_for({request.target().data(), request.target().size()}, "/live");
    }

    Implementation& all;
    beast::tcp_stream stream;
    beast::flat_buffer buffer;
    http::request_parser<http::string_body> parser;
    Response response;
  };

  /// A descriptor that is watched.
  struct Watched : std::enable_shared_from_this<Watched> {
    Watched(asio::io_context& context, int number, std::function<void()> ready)
        : descriptor(context, number), ready(std::move(ready)) {}
    ~Watched() { descriptor.release(); }

    void wait() {
      descriptor.async_wait(asio::posix::descriptor_base::wait_read, [self = shared_from_this()](error_code error) {
        if (error || self->is_forgotten) return;
        self->ready();
        if (!self->is_forgotten) self->wait();
      });
    }

    asio::posix::stream_descriptor descriptor;
    std::function<void()> ready;
    bool is_forgotten = false;
  };

  struct Repeated {
    Repeated(asio::io_context& context, int milliseconds, std::function<void()> action)
        : timer(context), period(milliseconds), action(std::move(action)) {}

    void wait() {
      timer.expires_after(period);
      timer.async_wait([this](error_code error) {
        if (error) return;
        action();
        wait();
      });
    }

    asio::steady_timer timer;
    std::chrono::milliseconds period;
    std::function<void()> action;
  };

  explicit Implementation(WebServer& server) : server(server), acceptor(context) {}

  std::shared_ptr<Client> add(beast::tcp_stream stream) {
    const ClientNumber number = ++last_number;
    return clients[number] = std::make_shared<Client>(*this, number, std::move(stream));
  }

  void accept() {
    acceptor.async_accept([this](error_code error, Tcp::socket socket) {
      if (error == asio::error::operation_aborted) return;
      if (!error && connections < connections_max) std::make_shared<Connection>(*this, std::move(socket))->read();
      accept();
    });
  }

  WebServer& server;
  asio::io_context context{1};
  Tcp::acceptor acceptor;
  Rules rules;
  std::size_t connections = 0;
  ClientNumber last_number = 0;
  std::map<ClientNumber, std::shared_ptr<Client>> clients;
  std::map<int, std::shared_ptr<Watched>> watched;
  std::list<Repeated> repeated;
};

WebServer::WebServer(const WebServerOptions& options, const std::string& option)
    : all_(std::make_unique<Implementation>(*this)) {
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
                 options.token, options.page};
  all_->accept();
}

WebServer::~WebServer() = default;

std::string WebServer::url() const { return "http://" + all_->rules.host + "/?token=" + all_->rules.token; }

void WebServer::send(ClientNumber client, std::string text) {
  if (const auto found = all_->clients.find(client); found != all_->clients.end()) found->second->send(std::move(text));
}

std::size_t WebServer::queued(ClientNumber client) const {
  const auto found = all_->clients.find(client);
  return found != all_->clients.end() ? found->second->queued : 0;
}

void WebServer::close(ClientNumber client) {
  if (const auto found = all_->clients.find(client); found != all_->clients.end()) found->second->end();
}

void WebServer::watch(int descriptor, std::function<void()> ready) {
  const auto watched = std::make_shared<Implementation::Watched>(all_->context, descriptor, std::move(ready));
  all_->watched[descriptor] = watched;
  watched->wait();
}

void WebServer::forget(int descriptor) {
  const auto found = all_->watched.find(descriptor);
  if (found == all_->watched.end()) return;
  found->second->is_forgotten = true;
  // Its wait must not outlive the descriptor, whose number another file may get.
  found->second->descriptor.release();
  all_->watched.erase(found);
}

void WebServer::repeat(int milliseconds, std::function<void()> action) {
  all_->repeated.emplace_back(all_->context, milliseconds, std::move(action)).wait();
}

void WebServer::run() { all_->context.run(); }

void WebServer::stop() { all_->context.stop(); }

}  // namespace waitpoint::tools::view
