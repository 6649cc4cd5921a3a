// Lists of sources.
#include "sources.h"

#include "curves.h"

#include <algorithm>
#include <utility>

namespace brushfire::tool {

std::vector<Where> parse_sources(const SharedArguments& arguments) {
  std::vector<Where> places;
  for (const std::string& text : split_places(arguments.sources)) places.push_back(parse_where(text));
  const std::string& file = arguments.sources_file;
  if (!file.empty()) {
    for (Where& w : read_where_file(file, true)) places.push_back(std::move(w));
  }
  if (places.empty()) {
    refuse(file.empty() ? "where from? give --source or --sources" : file + ": no source in this file");
  }
  return places;
}

std::vector<Where> parse_point_sources(const SharedArguments& arguments, const char* reason) {
  std::vector<Where> places = parse_sources(arguments);
  for (const Where& w : places) {
    if (w.is_curve()) refuse(in_quotes(w.text) + " is a curve: " + reason);
  }
  return places;
}

std::vector<SurfacePoint> open_places_of(const Domain& domain, std::span<const Source> sources) {
  std::vector<SurfacePoint> open;
  const auto add = [&](const SurfacePoint& p) {
    if (p.is_nowhere()) return;  // between pieces of a curve
    const std::vector<SurfacePoint> sides = domain.on_open(p);
    open.insert(open.end(), sides.begin(), sides.end());
  };
  for (const Source& s : sources) {
    if (s.curve) {
      std::for_each(s.curve->places.begin(), s.curve->places.end(), add);
    } else {
      add(s.point);
    }
  }
  return open;
}

std::vector<Where> parse_places(const std::vector<std::string>& texts, const char* what) {
  std::vector<Where> places;
  for (const std::string& text : split_places(texts)) {
    places.push_back(parse_where(text));
    if (places.back().is_curve()) refuse("'" + text + "' is a curve, and " + what + " is a place");
    if (places.back().has_offset) refuse("'" + text + "': " + what + " has no offset");
  }
  return places;
}

std::vector<Source> sources_on(const Surface& surface, PlaceFinder& finder, const std::vector<Where>& places) {
  std::vector<Source> sources;
  for (const Where& w : places) {
    if (!w.is_curve()) {
      sources.push_back({finder.source(surface.place(w)), w.offset});
      continue;
    }
    for (Source& s : curve_sources(surface, finder, w)) sources.push_back(std::move(s));
  }
  return sources;
}

}  // namespace brushfire::tool
