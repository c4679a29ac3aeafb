#include "core/mill/left/cure.hpp"

#include <cmath>

namespace sculpt {
namespace {

std::string millimetres(double length_m) {
  const auto tenths = std::lround(1e4 * length_m);
  return std::to_string(tenths / 10) + (tenths % 10 != 0 ? "." + std::to_string(tenths % 10) : "");
}

}  // namespace

const char* name(Obstacle obstacle) {
  switch (obstacle) {
    case Obstacle::way:
      return "way";
    case Obstacle::length:
      return "length";
    case Obstacle::radius:
      return "radius";
    case Obstacle::side:
      return "side";
  }
  return "unknown";
}

std::string Cure::sentence() const {
  const std::string cutter = "D" + millimetres(diameter_m);
  switch (obstacle) {
    case Obstacle::way:
      if (resolution > 0)
        return cutter + " has room there, but the voxels are too large for its ways: take a resolution of " +
               std::to_string(resolution) + " or more";
      return cutter + " has room there, but no pass was worth it or no way was found";
    case Obstacle::length:
    case Obstacle::radius:
      return cutter + " with " + millimetres(free_m) + " mm free would reach it";
    case Obstacle::side:
      return "no cutter of 0.5 mm or more comes to it along these directions: turn the part over";
  }
  return {};
}

}  // namespace sculpt
