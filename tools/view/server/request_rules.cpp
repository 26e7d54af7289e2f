// SPDX-License-Identifier: BSD-3-Clause
#include "tools/view/server/request_rules.hpp"

#include <boost/asio/ip/address.hpp>

namespace waitpoint::tools::view {

namespace http = boost::beast::http;

namespace {

constexpr std::string_view own_scheme = "http://";
constexpr const char* token_expected = "expected the address with the token that waitpoint printed\n";
constexpr const char* host_expected = "this address is not the server's own\n";

std::string_view field(const Request& request, http::field name) {
  return {request[name].data(), request[name].size()};
}

Response begin(const Request& request) {
  Response response(http::status::ok, request.version());
  response.set(http::field::cache_control, "no-store");
  response.set("X-Content-Type-Options", "nosniff");
  response.set("Referrer-Policy", "no-referrer");
  response.set(http::field::content_type, "text/plain; charset=utf-8");
  response.keep_alive(false);
  return response;
}

Response end(Response response, const Request& request) {
  response.prepare_payload();
  if (request.method() == http::verb::head) response.body().clear();
  return response;
}

}  // namespace

std::string_view RequestRules::path(const Request& request) {
  const std::string_view target(request.target().data(), request.target().size());
  return target.substr(0, target.find('?'));
}

// Names other than localhost are refused: a page of another site could give its own name this machine's address.
bool RequestRules::knows(std::string_view text) const {
  if (text == host || text == local_host) return true;
  const std::size_t port = text.rfind(':');
  if (!is_any_address || port == std::string_view::npos ||
      text.substr(port) != std::string_view(host).substr(host.rfind(':')))
    return false;
  std::string_view address = text.substr(0, port);
  if (address.starts_with('[') && address.ends_with(']')) address = address.substr(1, address.size() - 2);
  boost::system::error_code bad;
  (void)boost::asio::ip::make_address(std::string(address), bad);
  return !bad;
}

bool RequestRules::has_token(const Request& request) const {
  const std::string_view target(request.target().data(), request.target().size());
  const std::size_t query = target.find('?');
  return query != std::string_view::npos && target.substr(query + 1) == "token=" + token;
}

bool RequestRules::is_own(std::string_view origin) const {
  return origin.empty() || (origin.starts_with(own_scheme) && knows(origin.substr(own_scheme.size())));
}

Response RequestRules::error(const Request& request, http::status status, const std::string& text) {
  Response response = begin(request);
  response.result(status);
  response.body() = text;
  return end(std::move(response), request);
}

Response RequestRules::answer(const Request& request) const {
  if (request.method() != http::verb::get && request.method() != http::verb::head)
    return error(request, http::status::method_not_allowed, "expected GET\n");
  if (!knows(field(request, http::field::host))) return error(request, http::status::forbidden, host_expected);
  if (path(request) != "/") return error(request, http::status::not_found, "there is only one page\n");
  if (!has_token(request)) return error(request, http::status::forbidden, token_expected);
  Response response = begin(request);
  response.set(http::field::content_type, "text/html; charset=utf-8");
  response.set("Content-Security-Policy",
               "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data:; "
               "connect-src 'self' ws://" +
                   std::string(field(request, http::field::host)) +
                   "; base-uri 'none'; form-action 'none'; "
                   "frame-ancestors 'none'");
  response.body() = page;
  return end(std::move(response), request);
}

std::optional<Response> RequestRules::refusal(const Request& request) const {
  if (!knows(field(request, http::field::host))) return error(request, http::status::forbidden, host_expected);
  if (!has_token(request)) return error(request, http::status::forbidden, token_expected);
  if (!is_own(field(request, http::field::origin)))
    return error(request, http::status::forbidden, "pages of this origin may not connect\n");
  return std::nullopt;
}

}  // namespace waitpoint::tools::view
