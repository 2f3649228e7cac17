#include "ortung/server/CallArguments.hpp"

#include <charconv>

#include "Request.hpp"
#include "ortung/server/ServedWorld.hpp"

namespace ortung {
namespace {

std::string lineOf(const std::string& name, const BoardCommand::Call& call) {
  std::string line = name;
  for (const std::string& word : call.words) line += " " + word;
  for (const auto& [key, value] : call.keys) line += " " + key + "=" + value;
  return line;
}

}  // namespace

CallArguments::CallArguments(const std::string& name, const BoardCommand::Call& call)
    : request_(std::make_unique<server::Request>(lineOf(name, call))) {}
CallArguments::~CallArguments() = default;

std::vector<std::string> CallArguments::takeWords() { return request_->takeWords(); }

std::optional<std::string> CallArguments::takeText(std::string_view key) {
  return request_->takeText(key);
}

std::optional<double> CallArguments::takeNumber(std::string_view key, double low, double high) {
  return request_->takeNumber(key, low, high);
}

std::optional<std::int64_t> CallArguments::takeInteger(std::string_view key, std::int64_t low,
                                                       std::int64_t high) {
  return request_->takeInteger(key, low, high);
}

std::optional<Pose2> CallArguments::takePose() { return request_->takePose(); }

void CallArguments::refuseRest() const { request_->refuseRest(); }

std::uint64_t sinceOf(const BoardCommand::Call& call) {
  std::uint64_t since = 0;
  for (const auto& [key, value] : call.keys) {
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), since);
    if (key != "since" || error != std::errc() || end != value.data() + value.size())
      throw ServeError("argument", "EVENTS has '" + key + "=" + value +
                                       "', expected since=N, a number that it gave before");
  }
  return since;
}

}  // namespace ortung
