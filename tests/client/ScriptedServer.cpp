#include "ScriptedServer.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace ortung::test {
namespace {

/// What a server without features says.
std::string usual(const std::string& request) {
  const std::string command = request.substr(0, request.find_first_of(" \n"));
  std::string reply = "OK " + command;
  if (command == "HELLO") reply += " ortung/1 client=1 role=player kind=simulation now=0";
  if (command == "CREATE") reply += " robot=1 features=0";
  if (command == "TIME") reply += " received=0 sent=0";
  return reply;
}

}  // namespace

ScriptedServer::ScriptedServer(Script script) : script_(std::move(script)) {
  listener_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  if (::bind(listener_, reinterpret_cast<const sockaddr*>(&address), size) != 0 ||
      ::listen(listener_, 8) != 0 ||
      ::getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size) != 0)
    throw std::runtime_error(std::string("no server for the test: ") + std::strerror(errno));
  port_ = ntohs(address.sin_port);
  thread_ = std::thread([this] {
    while (!isOver_) {
      const int client = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
      if (client < 0) continue;
      client_ = client;
      if (!isOver_) talk(client);
      client_ = -1;
      ::close(client);
    }
  });
}

ScriptedServer::~ScriptedServer() {
  isOver_ = true;
  ::shutdown(listener_, SHUT_RDWR);
  if (const int client = client_; client >= 0) ::shutdown(client, SHUT_RDWR);
  thread_.join();
  ::close(listener_);
}

void ScriptedServer::talk(int client) {
  input_.clear();
  while (auto request = line(client)) {
    std::string tag;
    if (request->starts_with('#')) {
      tag = request->substr(0, request->find(' ') + 1);
      request->erase(0, tag.size());
    }
    if (request->starts_with("CREATE"))
      for (auto rest = line(client); rest && *rest != "."; rest = line(client)) {
      }
    const std::optional<std::string> reply = script_(*request);
    if (!reply || *reply == kFlood) isHung_ = true;
    if (reply && *reply == kFlood)
      while (send(client, "* SAY client=2 name=bert hi\n")) {
      }
    if (isHung_) continue;
    if (!send(client, tag + (reply->empty() ? usual(*request) : *reply) + "\n")) return;
  }
}

bool ScriptedServer::send(int client, const std::string& text) {
  return ::send(client, text.data(), text.size(), MSG_NOSIGNAL) ==
         static_cast<ssize_t>(text.size());
}

std::optional<std::string> ScriptedServer::line(int client) {
  std::size_t end;
  while ((end = input_.find('\n')) == input_.npos) {
    char piece[4096];
    const ssize_t count = ::recv(client, piece, sizeof piece, 0);
    if (count <= 0) return std::nullopt;
    input_.append(piece, static_cast<std::size_t>(count));
  }
  std::string result = input_.substr(0, end);
  input_.erase(0, end + 1);
  return result;
}

}  // namespace ortung::test
