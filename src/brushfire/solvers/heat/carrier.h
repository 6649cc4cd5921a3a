// Heat from some vertices of a surface, and what it carries along, however far it has to go.
#pragma once

#include <brushfire/solvers/heat/connection.h>
#include <brushfire/solvers/heat/relay.h>

#include <cstddef>
#include <span>
#include <vector>

namespace brushfire::heat {

// Solutions of both heat equations for right-hand sides that begin at the same vertices. Numbers of vertex v are in
// units of Heat::kStep^heat().level[v]: what counts are quotients and directions.
class Carrier {
 public:
  // One unit of heat from each of the vertices. Throws Error(InvalidArgument) without Eigen.
  Carrier(VectorSystem& system, std::span<const Index> from);

  const Heat& heat() const { return heat_; }

  // From right-hand sides to solutions, in place: `width` columns of values side by side; vectors. None may be larger
  // by far than the heat where they are.
  void carry(std::size_t width, std::span<double> x) const;
  void carry(std::span<Complex> x) const;

 private:
  template <class Scalar>
  void spread(const HeatEquation<Scalar>& equation, std::size_t width, std::span<Scalar> x) const;

  VectorSystem& system_;
  Heat heat_;
};

}  // namespace brushfire::heat
