#include "Http.hpp"

#include <algorithm>

namespace ortung::server {
namespace {

constexpr std::string_view kHostLine = "Host:";
constexpr std::string_view kBeginnings[] = {"GET ",    "HEAD ",    "POST ",  "PUT ",
                                            "DELETE ", "OPTIONS ", "PATCH ", "CONNECT ",
                                            "TRACE ",  "PRI * ",   kHostLine};

}  // namespace

Speech speechOf(std::string_view bytes) {
  Speech speech = Speech::kOther;
  for (const std::string_view beginning : kBeginnings) {
    if (bytes.starts_with(beginning)) return Speech::kHttp;
    if (beginning.starts_with(bytes)) speech = Speech::kUnknown;
  }
  return speech;
}

bool isHttpRequest(std::string_view bytes) { return !bytes.starts_with(kHostLine); }

std::size_t httpHeadLength(std::string_view bytes) {
  const std::size_t proper = bytes.find("\r\n\r\n");
  const std::size_t bare = bytes.find("\n\n");  // some programs leave the carriage returns out
  if (proper == bytes.npos && bare == bytes.npos) return bytes.npos;
  return proper < bare ? proper + 4 : bare + 2;
}

std::string httpAnswer(std::string_view request, std::string_view status, std::string_view text) {
  std::string answer = "HTTP/1.1 ";
  answer.append(status).append(
      "\r\nContent-Type: text/plain; charset=us-ascii\r\nContent-Length: ");
  answer.append(std::to_string(text.size())).append("\r\nConnection: close\r\n\r\n");
  if (!request.starts_with("HEAD ")) answer.append(text);
  return answer;
}

}  // namespace ortung::server
