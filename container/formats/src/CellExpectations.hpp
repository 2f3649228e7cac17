#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "CellWeigher.hpp"
#include "Expectations.hpp"
#include "FormatTools.hpp"

namespace ortung {

/// Expectations of a feature that reads one number or nothing: one table over the position.
/// @tparam Table PositionTable or BearingTable
/// @tparam Data the feature's class
template <class Table, class Data>
class CellExpectations : public Expectations {
 public:
  /// @param name of the table's array in files
  CellExpectations(const Data& feature, const char* name, Table empty, const SensorModel& model)
      : feature_(feature),
        name_(name),
        empty_(std::move(empty)),
        table_(std::make_shared<Table>(empty_)),
        gaussian_(std::make_shared<GaussianTable>(model)) {}

  double headingSpacing() const override { return spacingOf(feature_.config().fieldOfView); }
  void start(const FieldRegion& region, double) override {
    table_ = std::make_shared<Table>(empty_);
    table_->start(region.grid);
  }
  void save(TableWriter& file, const std::string& prefix) const override {
    table_->cells().save(file, prefix + name_);
  }
  void load(const std::shared_ptr<const TableFile>& file, const std::string& prefix,
            const FieldGrid& grid) override {
    auto table = std::make_shared<Table>(empty_);
    table->cells().load(file, prefix + name_, grid);
    table_ = std::move(table);
  }
  std::shared_ptr<const Weigher> weigher() const override {
    const std::optional<double> reading = feature_.reading();
    if (!reading) return nullptr;
    return std::make_shared<CellWeigher<Table>>(table_, gaussian_, feature_.config().model,
                                                feature_.mount(), *reading, sigmaAt(*reading));
  }

 protected:
  const Data& feature() const { return feature_; }
  Table& table() { return *table_; }
  const Table& table() const { return *table_; }

 private:
  /// Returns the standard deviation of a reading.
  virtual double sigmaAt(double reading) const = 0;

  const Data& feature_;
  const char* name_;
  Table empty_;
  std::shared_ptr<Table> table_;
  std::shared_ptr<const GaussianTable> gaussian_;
};

}  // namespace ortung
