#include "core/search/search.hpp"

#include <string>

#include "core/base/error.hpp"

namespace sculpt {

const char* name(Search search) {
  switch (search) {
    case Search::sweep:
      return "sweep";
    case Search::octree:
      return "octree";
    case Search::voxel:
      return "voxel";
    case Search::mill:
      return "mill";
  }
  return "unknown";
}

Search parse_search(std::string_view text) {
  for (const Search search : {Search::sweep, Search::octree, Search::voxel, Search::mill})
    if (text == name(search)) return search;
  throw InputError("search_unknown",
                   "search '" + std::string(text) + "' is not known: use mill, octree, sweep or voxel");
}

}  // namespace sculpt
