// Lists of sources.
#include "sources.h"

#include "command_line.h"

#include <utility>

namespace brushfire::tool {

std::vector<Where> parse_sources(const std::vector<std::string>& texts, const std::string& file) {
  std::vector<Where> places;
  for (const std::string& text : split_places(texts)) places.push_back(parse_where(text));
  if (!file.empty()) {
    for (Where& w : read_where_file(file)) places.push_back(std::move(w));
  }
  if (places.empty()) {
    refuse(file.empty() ? "where from? give --source or --sources" : file + ": no source in this file");
  }
  return places;
}

}  // namespace brushfire::tool
