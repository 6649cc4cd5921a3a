// WindowField: handed on to the reader of the run's own numbers.
#include <brushfire/solvers/windows/detail/field_reader.h>

#include <utility>

namespace brushfire {

WindowField::WindowField(std::shared_ptr<const detail::WindowFieldReader> reader) : reader_(std::move(reader)) {}

const Mesh& WindowField::mesh() const noexcept { return reader_->mesh(); }

WindowField::Value WindowField::value(const SurfacePoint& point) const { return reader_->value(point); }

WindowField::Leg WindowField::last_leg(Index vertex) const { return reader_->last_leg(vertex); }

WindowField::Leg WindowField::last_leg(const SurfacePoint& point) const { return reader_->last_leg(point); }

}  // namespace brushfire
