// The methods: their names, and which engine runs which.
#include <brushfire/solvers/detail/methods.h>

#include <brushfire/core/error.h>
#include <brushfire/solvers/carried_source/detail/engine.h>
#include <brushfire/solvers/detail/dijkstra.h>
#include <brushfire/solvers/fast_marching/detail/fast_marching.h>
#include <brushfire/solvers/heat/cholesky.h>
#include <brushfire/solvers/heat/engine.h>
#include <brushfire/solvers/windows/engine.h>

#include <array>
#include <string>

namespace brushfire {
namespace {

constexpr std::array kMethods{
    Method::Windows,          Method::Exact,         Method::CarriedSource, Method::NovotniKlein,
    Method::NovotniKlein2002, Method::KimmelSethian, Method::Dijkstra,      Method::Heat};

}  // namespace

std::string_view name_of(Method method) {
  switch (method) {
    case Method::Windows:
      return "windows";
    case Method::Exact:
      return "exact";
    case Method::CarriedSource:
      return "carried-source";
    case Method::NovotniKlein:
      return "novotni-klein";
    case Method::NovotniKlein2002:
      return "novotni-klein-2002";
    case Method::KimmelSethian:
      return "kimmel-sethian";
    case Method::Dijkstra:
      return "dijkstra";
    case Method::Heat:
      return "heat";
  }
  return "unknown";
}

Method method_named(std::string_view name) {
  std::string known;
  if (name == name_of(Method::Heat)) heat::require_factorization();
  for (const Method m : all_methods()) {
    if (name_of(m) == name) return m;
    known += std::string(known.empty() ? "" : ", ") + std::string(name_of(m));
  }
  throw Error(ErrorCode::InvalidArgument, "unknown method '" + std::string(name) + "': it is one of " + known);
}

std::span<const Method> all_methods() {
  return heat::can_factor() ? std::span(kMethods) : std::span(kMethods).first(kMethods.size() - 1);  // heat is the last
}

namespace detail {

Method engine_of(Method method) {
  if (method == Method::Exact) return Method::Windows;
  return method == Method::NovotniKlein2002 || method == Method::KimmelSethian ? Method::NovotniKlein : method;
}

std::unique_ptr<Engine> make_engine(const Mesh& mesh, Method method) {
  switch (engine_of(method)) {
    case Method::Windows:
      return windows::make_windows(mesh);
    case Method::CarriedSource:
      return carried_source::make_engine(mesh);
    case Method::NovotniKlein:
      return fast_marching::make_engine(mesh);
    case Method::Dijkstra:
      return make_dijkstra(mesh);
    case Method::Heat:
      return heat::make_engine(mesh);
    default:
      break;
  }
  throw Error(ErrorCode::InvalidArgument, "no such method");
}

}  // namespace detail
}  // namespace brushfire
