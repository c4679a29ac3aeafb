#include "core/mesh/collada.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "core/base/error.hpp"
#include "core/mesh/polygon.hpp"

namespace sculpt {
namespace {

using tinyxml2::XMLElement;
using Transform = Eigen::Affine3d;

constexpr int deepest = 64;  // nodes in nodes, and in nodes of the library

[[noreturn]] void refuse_collada(const std::string& what) {
  throw InputError("mesh_unreadable",
                   "the file is no readable .dae mesh (" + what + "): export it again as binary STL");
}

[[noreturn]] void refuse_collada(const XMLElement& element, const std::string& what) {
  refuse_collada("<" + std::string(element.Name()) + "> in line " + std::to_string(element.GetLineNum()) + " " + what);
}

const XMLElement& child(const XMLElement& element, const char* name) {
  const XMLElement* found = element.FirstChildElement(name);
  if (found == nullptr) refuse_collada(element, "has no <" + std::string(name) + ">");
  return *found;
}

std::string attribute(const XMLElement& element, const char* name) {
  const char* text = element.Attribute(name);
  if (text == nullptr) refuse_collada(element, "has no " + std::string(name));
  return text;
}

/// The id behind the '#' of a reference into this file; empty for one into another.
std::string target(const std::string& reference) {
  return reference.starts_with('#') ? reference.substr(1) : std::string();
}

/// Calls `take` with each word of the element's text.
template <typename Take>
void for_each_word(const XMLElement& element, const Take& take) {
  const char* text = element.GetText();
  if (text == nullptr) return;
  const std::string_view all = text;
  for (std::size_t at = 0; at < all.size();) {
    while (at < all.size() && std::isspace(static_cast<unsigned char>(all[at]))) ++at;
    std::size_t end = at;
    while (end < all.size() && !std::isspace(static_cast<unsigned char>(all[end]))) ++end;
    if (end > at) take(all.substr(at, end - at));
    at = end;
  }
}

std::vector<double> numbers(const XMLElement& element) {
  std::vector<double> found;
  for_each_word(element, [&](std::string_view word) {
    const auto number = parse_coordinate(word);
    if (!number) refuse_collada(element, "has '" + std::string(word) + "', which is no number");
    found.push_back(*number);
  });
  return found;
}

std::vector<double> numbers(const XMLElement& element, std::size_t count) {
  std::vector<double> found = numbers(element);
  if (found.size() != count) refuse_collada(element, "must have " + std::to_string(count) + " numbers");
  return found;
}

std::vector<std::uint32_t> indices(const XMLElement& element) {
  std::vector<std::uint32_t> found;
  for_each_word(element, [&](std::string_view word) {
    std::uint32_t index = 0;
    const auto read = std::from_chars(word.data(), word.data() + word.size(), index);
    if (read.ec != std::errc() || read.ptr != word.data() + word.size())
      refuse_collada(element, "has '" + std::string(word) + "', which is no whole number from 0 on");
    found.push_back(index);
  });
  return found;
}

/// What a step of a node does; nothing for an element that is none.
std::optional<Transform> transform_of(const XMLElement& element) {
  const std::string_view name = element.Name();
  Transform transform = Transform::Identity();
  if (name == "matrix") {
    const std::vector<double> m = numbers(element, 16);
    transform.matrix() = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(m.data());
    return transform;
  }
  if (name == "translate" || name == "scale") {
    const std::vector<double> v = numbers(element, 3);
    const Vec3 by(v[0], v[1], v[2]);
    return name == "scale" ? transform.scale(by) : transform.translate(by);
  }
  if (name != "rotate") return std::nullopt;
  const std::vector<double> v = numbers(element, 4);
  const Vec3 axis(v[0], v[1], v[2]);
  if (!(axis.norm() > 0)) refuse_collada(element, "turns about no axis");
  return transform.rotate(Eigen::AngleAxisd(v[3] * std::numbers::pi / 180, axis.normalized()));
}

/// Corners and faces of one <geometry>, in its own frame.
class Geometry {
 public:
  explicit Geometry(const XMLElement& geometry) {
    const XMLElement* mesh = geometry.FirstChildElement("mesh");
    if (mesh == nullptr) return;  // a spline, say
    for (const XMLElement* part = mesh->FirstChildElement(); part != nullptr; part = part->NextSiblingElement()) {
      const std::string_view kind = part->Name();
      if (kind == "triangles" || kind == "polylist" || kind == "polygons") read_faces(*mesh, *part, kind);
    }
  }

  const Mesh& mesh() const { return mesh_; }

 private:
  /// Where in the tuples of <p> the corners are.
  struct Corners {
    std::size_t offset = 0, stride = 1;
    std::uint32_t first = 0, count = 0;  ///< in mesh_.vertices
  };

  void read_faces(const XMLElement& mesh, const XMLElement& part, std::string_view kind) {
    const Corners corners = read_corners(mesh, part);
    const XMLElement* sizes = part.FirstChildElement("vcount");
    std::vector<std::uint32_t> polygon;
    for (const XMLElement* p = part.FirstChildElement("p"); p != nullptr; p = p->NextSiblingElement("p")) {
      const std::vector<std::uint32_t> words = indices(*p);
      const std::size_t all = words.size() / corners.stride;
      std::size_t at = 0;
      const auto add = [&](std::size_t count) {
        if (count > all - at) refuse_collada(*p, "has fewer corners than its faces need");
        polygon.clear();
        for (std::size_t corner = at; corner < at + count; ++corner) {
          const std::uint32_t index = words[corner * corners.stride + corners.offset];
          if (index >= corners.count)
            refuse_collada(*p, "names corner " + std::to_string(index) + ", which there is not");
          polygon.push_back(corners.first + index);
        }
        add_polygon(polygon, mesh_);
        at += count;
      };
      if (kind == "triangles")
        while (all - at >= 3) add(3);
      else if (kind == "polygons")
        add(all);
      else if (sizes != nullptr)
        for (const std::uint32_t size : indices(*sizes)) add(size);
    }
  }

  Corners read_corners(const XMLElement& mesh, const XMLElement& part) {
    Corners corners;
    std::string source;
    for (const XMLElement* in = part.FirstChildElement("input"); in != nullptr; in = in->NextSiblingElement("input")) {
      const std::size_t offset = std::min(in->UnsignedAttribute("offset", 0), 64u);
      corners.stride = std::max(corners.stride, offset + 1);
      if (attribute(*in, "semantic") != "VERTEX") continue;
      corners.offset = offset;
      source = target(attribute(*in, "source"));
    }
    const XMLElement& vertices = with_id(mesh, "vertices", source, part);
    for (const XMLElement* in = vertices.FirstChildElement("input"); in != nullptr;
         in = in->NextSiblingElement("input"))
      if (attribute(*in, "semantic") == "POSITION")
        add_places(with_id(mesh, "source", target(attribute(*in, "source")), vertices), corners);
    return corners;
  }

  void add_places(const XMLElement& source, Corners& corners) {
    const auto known = places_.find(&source);
    if (known == places_.end()) {
      const std::vector<double> values = numbers(child(source, "float_array"));
      const XMLElement& accessor = child(child(source, "technique_common"), "accessor");
      const std::size_t stride = accessor.UnsignedAttribute("stride", 1),
                        offset = accessor.UnsignedAttribute("offset", 0);
      if (stride < 3 || stride > 64 || offset > values.size())
        refuse_collada(accessor, "gives no places of three coordinates");
      corners.first = static_cast<std::uint32_t>(mesh_.vertices.size());
      for (std::size_t at = offset; at + 3 <= values.size(); at += stride)
        mesh_.vertices.emplace_back(values[at], values[at + 1], values[at + 2]);
      corners.count = static_cast<std::uint32_t>(mesh_.vertices.size()) - corners.first;
      places_[&source] = {corners.first, corners.count};
    } else {
      std::tie(corners.first, corners.count) = known->second;
    }
  }

  static const XMLElement& with_id(const XMLElement& parent, const char* name, const std::string& id,
                                   const XMLElement& who) {
    for (const XMLElement* each = parent.FirstChildElement(name); each != nullptr;
         each = each->NextSiblingElement(name))
      if (!id.empty() && each->Attribute("id", id.c_str()) != nullptr) return *each;
    refuse_collada(who, "names <" + std::string(name) + " id=\"" + id + "\">, which there is not");
  }

  Mesh mesh_;
  std::map<const XMLElement*, std::pair<std::uint32_t, std::uint32_t>> places_;
};

/// Walks through the nodes of the scene.
class ShownScene {
 public:
  ShownScene(const XMLElement& root, std::uint64_t memory_cap_bytes) : root_(root), cap_(memory_cap_bytes) {
    index(root, 0);
  }

  Mesh read() {
    const XMLElement& shown = child(child(root_, "scene"), "instance_visual_scene");
    const XMLElement& scene = named(target(attribute(shown, "url")), shown);
    for (const XMLElement* node = scene.FirstChildElement("node"); node != nullptr;
         node = node->NextSiblingElement("node"))
      show(*node, Transform::Identity(), 0);
    const XMLElement* asset = root_.FirstChildElement("asset");
    const XMLElement* unit = asset == nullptr ? nullptr : asset->FirstChildElement("unit");
    const double metres = unit == nullptr ? 1 : unit->DoubleAttribute("meter", 1);
    if (!(metres > 0) || !std::isfinite(metres)) refuse_collada(*unit, "must have a meter above 0");
    for (Vec3& vertex : mesh_.vertices) vertex *= metres;
    return std::move(mesh_);
  }

 private:
  /// Nodes, scenes and geometries by their ids; the first of two alike counts.
  void index(const XMLElement& element, int depth) {
    if (depth > deepest) refuse_collada(element, "lies in more than " + std::to_string(deepest) + " others");
    for (const XMLElement* each = element.FirstChildElement(); each != nullptr; each = each->NextSiblingElement()) {
      const std::string_view name = each->Name();
      const char* id = each->Attribute("id");
      if (id != nullptr && (name == "node" || name == "geometry" || name == "visual_scene")) by_id_.emplace(id, each);
      if (name != "mesh") index(*each, depth + 1);
    }
  }

  const XMLElement& named(const std::string& id, const XMLElement& who) const {
    const auto at = by_id_.find(id);
    if (at == by_id_.end()) refuse_collada(who, "names '" + id + "', which there is not");
    return *at->second;
  }

  void show(const XMLElement& node, Transform at, int depth) {
    if (depth > deepest) refuse_collada(node, "lies in more than " + std::to_string(deepest) + " others, or in itself");
    if (++shown_ > cap_ / sizeof(Transform)) refuse_size();  // nodes without a geometry in one another
    for (const XMLElement* each = node.FirstChildElement(); each != nullptr; each = each->NextSiblingElement()) {
      const std::string_view name = each->Name();
      if (const auto step = transform_of(*each)) at = at * *step;
      if (name == "node") show(*each, at, depth + 1);
      if (name == "instance_node") show(named(target(attribute(*each, "url")), *each), at, depth + 1);
      if (name == "instance_geometry") add(named(target(attribute(*each, "url")), *each), at);
    }
  }

  void add(const XMLElement& geometry, const Transform& at) {
    const Mesh& part = geometries_.try_emplace(&geometry, geometry).first->second.mesh();
    const std::size_t triangles = mesh_.triangles.size() + part.triangles.size();
    const std::size_t vertices = mesh_.vertices.size() + part.vertices.size();
    if (triangles * sizeof(mesh_.triangles[0]) + vertices * sizeof(Vec3) > cap_) refuse_size();
    const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
    for (const Vec3& vertex : part.vertices) mesh_.vertices.push_back(at * vertex);
    const bool mirrored = at.linear().determinant() < 0;
    for (const auto& [a, b, c] : part.triangles)
      mesh_.triangles.push_back({first + a, first + (mirrored ? c : b), first + (mirrored ? b : c)});
  }

  [[noreturn]] void refuse_size() const {
    throw InputError("memory_cap", "the nodes of the .dae file show more than fits into " + std::to_string(cap_) +
                                       " bytes: export it with fewer triangles, or raise the memory cap");
  }

  const XMLElement& root_;
  const std::uint64_t cap_;
  std::uint64_t shown_ = 0;
  std::map<std::string, const XMLElement*, std::less<>> by_id_;
  std::map<const XMLElement*, Geometry> geometries_;
  Mesh mesh_;
};

}  // namespace

Mesh read_collada(std::string_view bytes, std::uint64_t memory_cap_bytes) {
  tinyxml2::XMLDocument document;
  if (document.Parse(bytes.data(), bytes.size()) != tinyxml2::XML_SUCCESS)
    refuse_collada(bytes.empty() ? "it is empty" : std::string(document.ErrorStr()));
  const XMLElement* root = document.RootElement();
  if (root == nullptr || std::string_view(root->Name()) != "COLLADA") refuse_collada("it has no <COLLADA>");
  return ShownScene(*root, memory_cap_bytes).read();
}

}  // namespace sculpt
