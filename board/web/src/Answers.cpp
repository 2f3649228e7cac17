#include "Answers.hpp"

#include <algorithm>
#include <boost/beast/http/rfc7230.hpp>

#include "HostCheck.hpp"

namespace ortung::web {
namespace {

namespace http = boost::beast::http;

std::string_view view(boost::beast::string_view text) { return {text.data(), text.size()}; }

/// The page needs nothing but itself and its own server, so nothing else is permitted to it.
constexpr const char* kPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; "
    "font-src 'self'; connect-src 'self'; worker-src 'self'; manifest-src 'self'; base-uri 'none'; "
    "form-action 'none'; frame-ancestors 'none'";

Response make(const Request& request, http::status status, std::string_view type) {
  Response response(status, request.version());
  response.set(http::field::content_type, boost::beast::string_view(type.data(), type.size()));
  response.set("Content-Security-Policy", kPolicy);
  response.set("X-Content-Type-Options", "nosniff");
  response.set("Referrer-Policy", "no-referrer");
  response.set("Cross-Origin-Opener-Policy", "same-origin");
  response.set("Cross-Origin-Resource-Policy", "same-origin");
  response.set(http::field::cache_control, "no-cache");
  response.keep_alive(request.keep_alive());
  return response;
}

}  // namespace

Response refusal(const Request& request, http::status status, std::string_view why) {
  Response response = make(request, status, "text/plain; charset=utf-8");
  response.body() = std::make_shared<const std::string>(std::string(why) + "\n");
  response.prepare_payload();
  return response;
}

Response farewell(http::status status, std::string_view why) {
  Response response = refusal(Request(), status, why);
  response.keep_alive(false);
  return response;
}

namespace {

Response answerWithBody(const Request& request, const Page& page, const WebConfig& config) {
  if (!isOwnHost(view(request[http::field::host]), config.hosts))
    return refusal(request, http::status::misdirected_request,
                   "This computer is not known by that name: use its address, or localhost.");
  if (request.method() != http::verb::head && request.method() != http::verb::get) {
    Response response =
        refusal(request, http::status::method_not_allowed, "Only GET and HEAD are known here.");
    response.set(http::field::allow, "GET, HEAD");
    return response;
  }
  const Page::File* file = page.find(view(request.target()));
  if (file == nullptr)
    return refusal(request, http::status::not_found, "There is no such file here.");
  Response response = make(request, http::status::ok, file->type);
  response.body() = file->bytes;
  response.prepare_payload();
  return response;
}

}  // namespace

Response answer(const Request& request, const Page& page, const WebConfig& config) {
  Response response = answerWithBody(request, page, config);
  if (request.method() == http::verb::head) response.body() = nullptr;  // its length stays
  return response;
}

Speaking speakingOf(const Request& request, const WebConfig& config) {
  Speaking speaking;
  const auto refuse = [&](http::status status, const char* why) {
    speaking.status = status;
    speaking.why = why;
    return speaking;
  };
  const std::string_view host = view(request[http::field::host]);
  if (!isOwnHost(host, config.hosts))
    return refuse(http::status::misdirected_request,
                  "This computer is not known by that name: use its address, or localhost.");
  if (!isOwnOrigin(view(request[http::field::origin]), host, config.origins))
    return refuse(http::status::forbidden, "Pages of other origins may not connect.");
  const std::string_view target = view(request.target());
  const std::string_view path = target.substr(0, target.find('?'));
  for (const auto& asked : http::token_list(request[http::field::sec_websocket_protocol]))
    for (const WebProtocol& protocol : config.protocols) {
      const auto& names = protocol.names;
      const bool isKnown = std::find(names.begin(), names.end(), view(asked)) != names.end();
      if (!isKnown || !(protocol.path.empty() || protocol.path == path)) continue;
      speaking.protocol = &protocol;
      speaking.name = std::string(view(asked));
      return speaking;
    }
  return refuse(http::status::bad_request,
                "None of the subprotocols that were offered is spoken here.");
}

}  // namespace ortung::web
