#pragma once

#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/message.hpp>
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

/// A refusal in words.
Response refusal(const Request& request, boost::beast::http::status status, std::string_view why);

/// The same as the last answer of a connection, whatever it has asked for.
Response farewell(boost::beast::http::status status, std::string_view why);

/// A request for a WebSocket: what is to be spoken on it, and under which name; or why not.
struct Speaking {
  const WebProtocol* protocol = nullptr;  ///< null: refused
  std::string name;                       ///< name of the subprotocol
  boost::beast::http::status status = boost::beast::http::status::bad_request;
  std::string why;
};
Speaking speakingOf(const Request& request, const WebConfig& config);

}  // namespace ortung::web
