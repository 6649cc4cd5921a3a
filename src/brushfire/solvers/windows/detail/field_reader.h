// What a WindowField asks of the run that made it, whatever the numbers of that run.
#pragma once

#include <brushfire/solvers/window_field.h>

namespace brushfire::detail {

// See WindowField, which says what each of these is.
class WindowFieldReader {
 public:
  WindowFieldReader() = default;
  WindowFieldReader(const WindowFieldReader&) = delete;
  WindowFieldReader& operator=(const WindowFieldReader&) = delete;
  virtual ~WindowFieldReader() = default;
  virtual WindowField::Value value(const SurfacePoint& point) const = 0;
  virtual WindowField::Leg last_leg(Index vertex) const = 0;
  virtual WindowField::Leg last_leg(const SurfacePoint& point) const = 0;
  virtual const Mesh& mesh() const noexcept = 0;
};

}  // namespace brushfire::detail
