#pragma once

#include <string>
#include <string_view>

namespace ortung::server {

/// What a connection begins to speak.
enum class Speech {
  kUnknown,  ///< its bytes could be the beginning of either
  kHttp,
  kOther,
};

/// Judges by the first bytes. A web page can make a browser send to any port of this computer, and
/// what it may send without asking (with OPTIONS) begins with one of few words: none of it must
/// reach the protocol.
Speech speechOf(std::string_view bytes);

/// Whether it begins as a request does; a line of a head without its request does not.
/// @pre speechOf(bytes) is kHttp
bool isHttpRequest(std::string_view bytes);

/// Length of HTTP's head with the empty line that ends it, or npos while it is not whole.
std::size_t httpHeadLength(std::string_view bytes);

/// A whole answer of HTTP, after which the connection is closed.
/// @param request what has come; a HEAD gets no body
/// @param status e.g. "501 Not Implemented"
std::string httpAnswer(std::string_view request, std::string_view status, std::string_view text);

}  // namespace ortung::server
