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

Response said(const Request& request, http::status status, std::string_view text) {
  Response response = make(request, status, "text/plain; charset=utf-8");
  response.body() = std::make_shared<const std::string>(std::string(text) + "\n");
  response.prepare_payload();
  return response;
}

Response farewell(http::status status, std::string_view why) {
  Response response = said(Request(), status, why);
  response.keep_alive(false);
  return response;
}

namespace {

Response answerWithBody(const Request& request, const Page& page, const WebConfig& config) {
  if (!isOwnHost(view(request[http::field::host]), config.hosts))
    return said(request, http::status::misdirected_request,
                "This computer is not known by that name: use its address, or localhost.");
  if (request.method() != http::verb::head && request.method() != http::verb::get) {
    Response response =
        said(request, http::status::method_not_allowed, "Only GET and HEAD are known here.");
    response.set(http::field::allow, "GET, HEAD");
    return response;
  }
  const std::string_view target = view(request.target());
  if (config.uploads.begin && target == config.uploads.path)
    return said(request, http::status::ok, "most=" + std::to_string(config.uploads.most));
  const Page::File* file = page.find(target);
  if (file == nullptr) return said(request, http::status::not_found, "There is no such file here.");
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

bool wantsUpload(const Request& request, const WebConfig& config) {
  const std::string_view target = view(request.target());
  return config.uploads.begin && request.method() == http::verb::post &&
         target.substr(0, target.find('?')) == config.uploads.path;
}

std::optional<WebReply> uploadRefusal(const Request& request, const WebConfig& config) {
  const std::string_view host = view(request[http::field::host]);
  if (!isOwnHost(host, config.hosts))
    return WebReply{421, "This computer is not known by that name: use its address, or localhost."};
  if (!isOwnOrigin(view(request[http::field::origin]), host, config.origins))
    return WebReply{403, "Pages of other origins may not send files."};
  constexpr std::string_view kBearer = "Bearer ";
  const std::string_view given = view(request[http::field::authorization]);
  const bool isAdmitted = given.starts_with(kBearer) && config.uploads.admits &&
                          config.uploads.admits(given.substr(kBearer.size()));
  if (!isAdmitted)
    return WebReply{403, "Only operators may send files: the token is missing or wrong."};
  return std::nullopt;
}

Response uploadAnswer(const Request& request, const WebReply& reply) {
  return said(request, http::int_to_status(reply.status), reply.text);
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
