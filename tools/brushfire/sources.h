// Where distances start from: --source, --sources and --snap-within.
#pragma once

#include "shared.h"
#include "surface.h"
#include "where.h"

#include <vector>

namespace brushfire::tool {

// The places of --source, and behind them those in the file of --sources. Throws Error(InvalidArgument) where there is
// none, and as parse_where() and read_where_file() do.
std::vector<Where> parse_sources(const SharedArguments& arguments);
// Places of other options, which have no value to start from: `what` is "a target". Throws Error(InvalidArgument).
std::vector<Where> parse_places(const std::vector<std::string>& texts, const char* what);

std::vector<Source> sources_on(const Surface& surface, PlaceFinder& finder, const std::vector<Where>& places);

}  // namespace brushfire::tool
