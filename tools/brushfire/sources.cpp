// Lists of sources.
#include "sources.h"

#include <utility>

namespace brushfire::tool {

std::vector<Where> parse_sources(const SharedArguments& arguments) {
  std::vector<Where> places;
  for (const std::string& text : split_places(arguments.sources)) places.push_back(parse_where(text));
  const std::string& file = arguments.sources_file;
  if (!file.empty()) {
    for (Where& w : read_where_file(file)) places.push_back(std::move(w));
  }
  if (places.empty()) {
    refuse(file.empty() ? "where from? give --source or --sources" : file + ": no source in this file");
  }
  return places;
}

std::vector<Where> parse_places(const std::vector<std::string>& texts, const char* what) {
  std::vector<Where> places;
  for (const std::string& text : split_places(texts)) {
    places.push_back(parse_where(text));
    if (places.back().has_offset) refuse("'" + text + "': " + what + " has no offset");
  }
  return places;
}

std::vector<Source> sources_on(const Surface& surface, PlaceFinder& finder, const std::vector<Where>& places) {
  std::vector<Source> sources;
  for (const Where& w : places) sources.push_back({finder.source(surface.place(w)), w.offset});
  return sources;
}

}  // namespace brushfire::tool
