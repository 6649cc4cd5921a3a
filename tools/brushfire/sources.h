// Where distances start from: --source, --sources and --snap-within.
#pragma once

#include "shared.h"
#include "surface.h"
#include "where.h"

#include <span>
#include <vector>

namespace brushfire::tool {

// The places of --source, and behind them those in the file of --sources. Throws Error(InvalidArgument) where there is
// none, and as parse_where() and read_where_file() do.
std::vector<Where> parse_sources(const SharedArguments& arguments);
// The same where curves are of no use: refused, with the reason.
std::vector<Where> parse_point_sources(const SharedArguments& arguments, const char* reason);
// Places of other options, which have no value to start from: `what` is "a target". Throws Error(InvalidArgument).
std::vector<Where> parse_places(const std::vector<std::string>& texts, const char* what);

// Where sources are, their points and the places of their curves, as points of what walls leave open.
std::vector<SurfacePoint> open_places_of(const Domain& domain, std::span<const Source> sources);

std::vector<Source> sources_on(const Surface& surface, PlaceFinder& finder, const std::vector<Where>& places);

}  // namespace brushfire::tool
