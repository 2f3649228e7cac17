#include "Catalogue.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace ortung::app {
namespace {

constexpr CatalogueEntry kCommands[] = {
#include "CatalogueCommands.inc"
};

constexpr CatalogueGroup kGroups[] = {
#include "CatalogueGroups.inc"
};

template <class Item>
const Item& itemNamed(std::span<const Item> items, std::string_view name) {
  const auto found =
      std::find_if(items.begin(), items.end(), [&](const Item& item) { return name == item.name; });
  if (found != items.end()) return *found;
  throw std::logic_error("'" + std::string(name) + "' is not in the catalogue of commands");
}

}  // namespace

std::span<const CatalogueEntry> catalogue() { return kCommands; }
std::span<const CatalogueGroup> catalogueGroups() { return kGroups; }
const CatalogueEntry& commandNamed(std::string_view name) { return itemNamed(catalogue(), name); }
const CatalogueGroup& groupNamed(std::string_view name) {
  return itemNamed(catalogueGroups(), name);
}

}  // namespace ortung::app
