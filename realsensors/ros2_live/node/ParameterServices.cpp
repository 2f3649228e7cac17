#include "ParameterServices.hpp"

#include <algorithm>
#include <stdexcept>

namespace ortung::ros2 {
namespace {

using Description = AmclParameters::Description;
using Value = AmclParameters::Value;
using Type = ParameterValue::Type;

std::uint8_t typeOf(const Value& value) { return static_cast<std::uint8_t>(1 + value.index()); }

ParameterValue toMessage(const Value& value) {
  ParameterValue message;
  message.type = typeOf(value);
  if (const auto* const flag = std::get_if<bool>(&value)) message.flag = *flag;
  if (const auto* const integer = std::get_if<std::int64_t>(&value)) message.integer = *integer;
  if (const auto* const number = std::get_if<double>(&value)) message.number = *number;
  if (const auto* const text = std::get_if<std::string>(&value)) message.text = *text;
  return message;
}

/// @throws std::invalid_argument for a type that no parameter here has
Value fromMessage(const NamedParameter& parameter) {
  switch (parameter.value.type) {
    case Type::kBool:
      return parameter.value.flag;
    case Type::kInteger:
      return parameter.value.integer;
    case Type::kDouble:
      return parameter.value.number;
    case Type::kString:
      return parameter.value.text;
    default:
      throw std::invalid_argument("parameter '" + parameter.name +
                                  "': found a list or nothing, expected a single value");
  }
}

/// Why a parameter can't be set; "" if it can.
std::string whyNot(const NamedParameter& parameter) {
  try {
    AmclParameters::check(parameter.name, fromMessage(parameter));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  if (AmclParameters::find(parameter.name)->kind == Description::Kind::kFixed)
    return "parameter '" + parameter.name + "' counts when the node starts, and is read-only now";
  return "";
}

ParameterDescriptor describe(const std::string& name) {
  ParameterDescriptor about;
  about.name = name;
  const Description* const known = AmclParameters::find(name);
  if (known == nullptr) return about;
  about.type = typeOf(known->byDefault);
  about.description = known->kind == Description::Kind::kNone
                          ? "without effect: " + std::string(known->effect)
                          : std::string(known->effect);
  about.isReadOnly = known->kind == Description::Kind::kFixed;
  if (about.type == Type::kDouble) about.floatRange = {{known->least, known->most, 0.0}};
  if (about.type == Type::kInteger)
    about.integerRange = {
        {static_cast<std::int64_t>(known->least), static_cast<std::int64_t>(known->most), 1}};
  return about;
}

/// Whether a name is one of a prefix ("": of all) and at most so many words below it; 0: any.
bool isBelow(std::string_view name, std::string_view prefix, std::uint64_t depth) {
  if (!prefix.empty()) {
    if (name == prefix) return true;
    if (!name.starts_with(prefix) || name[prefix.size()] != '.') return false;
    name.remove_prefix(prefix.size() + 1);
  }
  return depth == 0 ||
         static_cast<std::uint64_t>(std::count(name.begin(), name.end(), '.')) < depth;
}

std::vector<std::string> namesIn(std::string_view request) {
  std::vector<std::string> names;
  readCdr(request, names);
  return names;
}

}  // namespace

std::string ParameterServices::get(std::string_view request) const {
  std::vector<ParameterValue> values;
  const std::lock_guard lock(mutex_);
  for (const std::string& name : namesIn(request)) {
    // As rclcpp has it, a name that is none ends the answer.
    if (AmclParameters::find(name) == nullptr) return cdrOf(std::vector<ParameterValue>());
    values.push_back(toMessage(parameters_.get(name)));
  }
  return cdrOf(values);
}

std::string ParameterServices::types(std::string_view request) const {
  std::vector<std::uint8_t> types;
  for (const std::string& name : namesIn(request)) {
    const Description* const known = AmclParameters::find(name);
    if (known == nullptr) return cdrOf(std::vector<std::uint8_t>());
    types.push_back(typeOf(known->byDefault));
  }
  return cdrOf(types);
}

std::string ParameterServices::describe(std::string_view request) const {
  std::vector<ParameterDescriptor> all;
  for (const std::string& name : namesIn(request)) all.push_back(ros2::describe(name));
  return cdrOf(all);
}

std::string ParameterServices::list(std::string_view request) const {
  std::vector<std::string> prefixes;
  std::uint64_t depth = 0;
  readCdr(request, prefixes, depth);
  if (prefixes.empty()) prefixes.emplace_back();
  std::vector<std::string> names;
  std::vector<std::string> tables;
  for (const Description& one : AmclParameters::all()) {
    const std::string name(one.name);
    if (std::none_of(prefixes.begin(), prefixes.end(),
                     [&](const auto& prefix) { return isBelow(name, prefix, depth); }))
      continue;
    names.push_back(name);
    const std::size_t dot = name.rfind('.');
    if (dot == name.npos) continue;
    const std::string table = name.substr(0, dot);
    if (std::find(tables.begin(), tables.end(), table) == tables.end()) tables.push_back(table);
  }
  return cdrOf(names, tables);
}

void ParameterServices::change(const std::vector<NamedParameter>& wanted) {
  if (wanted.empty()) return;
  for (const NamedParameter& one : wanted) parameters_.set(one.name, fromMessage(one));
  listener_(parameters_.settings());
  ParameterEvent event;
  event.stamp = timeOfDay();
  event.node = node_;
  event.changed = wanted;
  if (events_) events_(cdrOf(event));
}

std::string ParameterServices::set(std::string_view request) {
  std::vector<NamedParameter> wanted;
  readCdr(request, wanted);
  std::vector<SetParameterResult> results;
  std::vector<NamedParameter> good;
  const std::lock_guard lock(mutex_);
  for (const NamedParameter& one : wanted) {
    const std::string why = whyNot(one);
    results.push_back({why.empty(), why});
    if (why.empty()) good.push_back(one);
  }
  change(good);
  return cdrOf(results);
}

std::string ParameterServices::setAtomically(std::string_view request) {
  std::vector<NamedParameter> wanted;
  readCdr(request, wanted);
  const std::lock_guard lock(mutex_);
  for (const NamedParameter& one : wanted)
    if (const std::string why = whyNot(one); !why.empty())
      return cdrOf(SetParameterResult{false, why});
  change(wanted);
  return cdrOf(SetParameterResult{true, ""});
}

void ParameterServices::tellStart() {
  ParameterEvent event;
  event.stamp = timeOfDay();
  event.node = node_;
  const std::lock_guard lock(mutex_);
  for (const Description& one : AmclParameters::all())
    event.added.push_back({std::string(one.name), toMessage(parameters_.get(one.name))});
  events_(cdrOf(event));
}

void ParameterServices::serve(Participant& node) {
  const auto offer = [&](const char* name, const char* type, Participant::Handler handler) {
    node.serve(std::string("~/") + name, std::string("rcl_interfaces/srv/") + type,
               std::move(handler));
  };
  events_ = node.publish("/parameter_events", ParameterEvent::kType, Qos::kDefault);
  offer("get_parameters", "GetParameters", [this](auto request) { return get(request); });
  offer("get_parameter_types", "GetParameterTypes",
        [this](auto request) { return types(request); });
  offer("describe_parameters", "DescribeParameters",
        [this](auto request) { return describe(request); });
  offer("list_parameters", "ListParameters", [this](auto request) { return list(request); });
  offer("set_parameters", "SetParameters", [this](auto request) { return set(request); });
  offer("set_parameters_atomically", "SetParametersAtomically",
        [this](auto request) { return setAtomically(request); });
  tellStart();
}

}  // namespace ortung::ros2
