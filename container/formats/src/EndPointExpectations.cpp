#include "EndPointExpectations.hpp"

namespace ortung {

void EndPointExpectations::start(const FieldRegion& region, double) {
  tables_ = std::make_shared<EndPointTables>();
  tables_->region = region.grid;
  tables_->field.start(region.grid, config_.cell, config_.margin);
  marked_ = std::make_shared<SurfaceField>();
  marked_->start(region, config_.cell, config_.margin);
  tables_->surfaces = marked_;
}

void EndPointExpectations::mark(double x, double y) {
  tables_->field.mark(x, y);
  marked_->mark(x, y);
}

void EndPointExpectations::finish() {
  tables_->field.finish();
  marked_->finish();
  marked_.reset();
  tables_->complete(config_.model, config_.maxRange);
}

void EndPointExpectations::save(TableWriter& file, const std::string& prefix) const {
  tables_->field.save(file, prefix);
  tables_->surfaces->save(file, prefix);
}

void EndPointExpectations::load(const std::shared_ptr<const TableFile>& file,
                                const std::string& prefix, const FieldGrid& grid) {
  auto tables = std::make_shared<EndPointTables>();
  tables->region = grid;
  tables->field.load(file, prefix);
  tables->surfaces = SurfaceField::of(file, prefix);
  tables->complete(config_.model, config_.maxRange);
  tables_ = std::move(tables);
}

}  // namespace ortung
