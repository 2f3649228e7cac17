#pragma once

#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/message.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "Page.hpp"
#include "SharedText.hpp"
#include "ortung/web/WebDoor.hpp"

namespace ortung::web {

using Request = boost::beast::http::request<boost::beast::http::empty_body>;
using Response = boost::beast::http::response<SharedText>;

/// What a request that is no WebSocket is answered: a file of the page, or why not.
Response answer(const Request& request, const Page& page, const WebConfig& config);

/// Words as an answer.
Response said(const Request& request, boost::beast::http::status status, std::string_view text);

/// The same as the last answer of a connection, whatever it has asked for.
Response farewell(boost::beast::http::status status, std::string_view why);

/// Whether a request wants to send a file: it is a POST to where files are taken.
bool wantsUpload(const Request& request, const WebConfig& config);

/// Why a file is not taken from who sends it; nothing: it is.
std::optional<WebReply> uploadRefusal(const Request& request, const WebConfig& config);

/// What is said to who has sent a file, or whose file is not taken.
Response uploadAnswer(const Request& request, const WebReply& reply);

/// A request for a WebSocket: what is to be spoken on it, and under which name; or why not.
struct Speaking {
  const WebProtocol* protocol = nullptr;  ///< null: refused
  std::string name;                       ///< name of the subprotocol
  boost::beast::http::status status = boost::beast::http::status::bad_request;
  std::string why;
};
Speaking speakingOf(const Request& request, const WebConfig& config);

}  // namespace ortung::web
