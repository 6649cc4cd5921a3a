// How distances are computed: what --method, --tolerance, --bound, --precision, --radius and --threads mean together.
#pragma once

#include "shared.h"

#include <brushfire/solvers/distance.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace brushfire::tool {

inline constexpr std::array<NumberWord, 4> kTolerancesInWords{
    {{"draft", 1e-2}, {"standard", 1e-3}, {"fine", 1e-5}, {"exact", 0}}};
inline constexpr Range kTolerances{.low = 0, .high = kMaxTolerance, .words = kTolerancesInWords};
std::vector<std::string> bound_names();

// What was asked for; where no method was, `otherwise`, or Method::Windows where a tolerance or a bound was: it is the
// one that keeps them. A method may be followed by its own detail, "windows:1e-4", "novotni-klein:float64" or
// "heat:4,averaged" (times the squared mean edge, what heat does at borders).
// Throws Error(InvalidArgument) where options do not fit together, or where there are several methods.
DistanceOptions computation(const SharedArguments& arguments, Method otherwise = DistanceOptions{}.method);
// One for each --method; for all of `otherwise` where there is none. A tolerance is for those that keep one: somebody
// has to.
std::vector<DistanceOptions> computations(const SharedArguments& arguments, const std::vector<Method>& otherwise);

// Whether --signed can be: signs are read off exact paths of lengths. Throws Error(InvalidArgument).
void check_signed(const SharedArguments& arguments);

// The relative error that the method keeps at every vertex; nullopt: it promises none.
std::optional<double> promised_error(const DistanceOptions& options);

// Methods that compute in the precision that is asked for.
bool has_precision(Method method);

std::string name_of(Bound bound);
// For JSON: null where the method has only one.
Record::Value precision_of(const DistanceOptions& options);
Record::Value tolerance_of(const DistanceOptions& options);

}  // namespace brushfire::tool
