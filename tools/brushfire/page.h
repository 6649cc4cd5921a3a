// The viewer's page: one file of HTML that a mesh is put into, and the browser that shows it.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace brushfire::tool {

// What is put into the page: the bytes of a PLY file, and what the page is to show of it, as JSON.
struct PageContent {
  std::string_view mesh;
  std::string state;
};

// The page without a mesh, as `./run web` builds it: the file that BRUSHFIRE_VIEWER names, else viewer.html in
// ../share/brushfire of the program's folder, or beside the program. Throws Error(FileNotReadable) where there is none,
// or where the file is another page.
std::string empty_page();

// The page with the mesh in it.
std::string page_with(std::string page, const PageContent& content);

// Shows the file in the system's browser. False where that cannot be: there is none, or no screen.
bool open_in_browser(const std::string& path);

}  // namespace brushfire::tool
