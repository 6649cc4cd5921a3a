// Where distances start from: --source and --sources of the verbs that take both.
#pragma once

#include "where.h"

#include <string>
#include <vector>

namespace brushfire::tool {

// The places of --source, and behind them those in the file of --sources (empty: none was given). Throws
// Error(InvalidArgument) where there is none, and as parse_where() and read_where_file() do.
std::vector<Where> parse_sources(const std::vector<std::string>& texts, const std::string& file);

}  // namespace brushfire::tool
