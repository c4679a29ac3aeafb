#include "core/mesh/mesh_file.hpp"

#include <assimp/BaseImporter.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <cmath>
#include <cstring>
#include <iterator>
#include <new>
#include <sstream>
#include <stdexcept>

#include "core/mesh/collada.hpp"
#include "core/mesh/gltf_guard.hpp"
#include "core/mesh/off.hpp"
#include "core/mesh/ply.hpp"
#include "core/mesh/vertex_join.hpp"

namespace sculpt {
namespace {

/// Peak bytes of memory a byte of file comes to while it is loaded: measured on a closed surface of 400 000 triangles
/// in the densest common form of each kind (4.4 for binary STL), plus a fifth and more.
struct Kind {
  const char* extension;
  double memory_per_byte;
};
constexpr std::array<Kind, 7> kinds{
    {{"stl", 6.5}, {"obj", 14}, {"ply", 10}, {"off", 8}, {"gltf", 9}, {"glb", 12}, {"dae", 9}}};

const Kind& find_kind(const std::string& extension) {
  for (const Kind& kind : kinds)
    if (extension == kind.extension) return kind;
  throw InputError("mesh_unreadable", "mesh kind \"" + extension +
                                          "\" is not known: convert the mesh to stl, obj, ply, off, glb, gltf or dae");
}

/// Reads the caller's bytes in place. A reader that asks for more at the end again and again would do so for ever: it
/// is stopped by an exception.
class ViewStream final : public Assimp::IOStream {
 public:
  explicit ViewStream(std::string_view bytes) : bytes_(bytes) {}
  size_t Read(void* out, size_t size, size_t count) override {
    if (size == 0) return 0;
    const size_t items = std::min(count, (bytes_.size() - at_) / size);
    std::memcpy(out, bytes_.data() + at_, items * size);
    at_ += items * size;
    if (items == 0 && count > 0 && ++reads_of_nothing_ > max_reads_of_nothing)
      throw std::runtime_error("it ends before it is complete");
    return items;
  }
  size_t Write(const void*, size_t, size_t) override { return 0; }
  aiReturn Seek(size_t offset, aiOrigin origin) override {
    const size_t base = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? at_ : bytes_.size();
    if (base + offset > bytes_.size()) return aiReturn_FAILURE;
    at_ = base + offset;
    return aiReturn_SUCCESS;
  }
  size_t Tell() const override { return at_; }
  size_t FileSize() const override { return bytes_.size(); }
  void Flush() override {}

 private:
  static constexpr int max_reads_of_nothing = 1000;
  std::string_view bytes_;
  size_t at_ = 0;
  int reads_of_nothing_ = 0;
};

/// Holds the one file, so that a mesh from a client can never make the server open another (assimp's own memory reader
/// falls back to the disk). Remembers the first other file asked for.
class OneFile final : public Assimp::IOSystem {
 public:
  OneFile(std::string name, std::string_view bytes, std::string& missing)
      : name_(std::move(name)), bytes_(bytes), missing_(missing) {}
  bool Exists(const char* file) const override { return file == name_; }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* file, const char*) override {
    if (file == name_) return new ViewStream(bytes_);
    if (missing_.empty()) missing_ = file;
    return nullptr;
  }
  void Close(Assimp::IOStream* stream) override { delete stream; }

 private:
  std::string name_;
  std::string_view bytes_;
  std::string& missing_;
};

void check_memory(std::uint64_t needed, std::uint64_t cap, const std::string& what) {
  if (needed > cap)
    throw InputError("memory_cap", "loading " + what + " is predicted to take " + std::to_string(needed) +
                                       " bytes of memory, the cap is " + std::to_string(cap) +
                                       ": raise the memory cap, or reduce the mesh to fewer triangles");
}

bool reads(const Assimp::BaseImporter& reader, const std::string& extension) {
  std::istringstream extensions(reader.GetInfo()->mFileExtensions);
  return std::find(std::istream_iterator<std::string>(extensions), {}, extension) !=
         std::istream_iterator<std::string>();
}

/// Assimp tries the readers of some fifty formats on a file that its own does not want: none but its own are left.
void keep_readers_of(const std::string& extension, Assimp::Importer& importer) {
  for (std::size_t at = importer.GetImporterCount(); at-- > 0;) {
    Assimp::BaseImporter* reader = importer.GetImporter(at);
    if (reads(*reader, extension)) continue;
    importer.UnregisterLoader(reader);
    delete reader;
  }
}

/// Assimp's own validation lets faces without corners through, and its triangulation ends the process for them.
bool has_face_without_corners(const aiScene& scene) {
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& mesh = *scene.mMeshes[m];
    if (std::any_of(mesh.mFaces, mesh.mFaces + mesh.mNumFaces,
                    [](const aiFace& face) { return face.mNumIndices == 0; }))
      return true;
  }
  return false;
}

const aiScene& import_scene(Assimp::Importer& importer, std::string_view bytes, const std::string& extension) {
  const std::string name = "mesh." + extension;
  std::string missing;
  keep_readers_of(extension, importer);
  importer.SetIOHandler(new OneFile(name, bytes, missing));  // the importer owns it
  const aiScene* scene = nullptr;
  std::string reason;
  try {
    scene = importer.ReadFile(name, aiProcess_ValidateDataStructure);
    if (scene != nullptr && has_face_without_corners(*scene)) throw std::runtime_error("it has faces without corners");
    if (scene != nullptr) scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
    if (scene == nullptr) reason = importer.GetErrorString();
  } catch (const std::bad_alloc&) {
    throw InputError("memory_cap", "the mesh does not fit into memory: reduce it to fewer triangles");
  } catch (const std::exception& error) {
    scene = nullptr;
    reason = error.what();
  }
  if (scene != nullptr && scene->mRootNode != nullptr) return *scene;
  if (!missing.empty() && (extension == "gltf" || extension == "glb"))
    throw InputError("mesh_unreadable", "the glTF file needs another file, " + missing +
                                            ", which was not sent: export it as one binary .glb file");
  throw InputError("mesh_unreadable",
                   "the file is no readable ." + extension + " mesh (" + reason + "): export it again as binary STL");
}

/// One appearance of a sub-mesh, with the transform of its node and all nodes above.
struct Part {
  const aiMesh* mesh;
  Eigen::Matrix4d transform;
};

void collect_parts(const aiScene& scene, const aiNode& node, const Eigen::Matrix4d& above, std::vector<Part>& parts) {
  Eigen::Matrix4d transform;
  for (unsigned row = 0; row < 4; ++row)
    for (unsigned column = 0; column < 4; ++column) transform(row, column) = node.mTransformation[row][column];
  transform = above * transform;
  for (unsigned m = 0; m < node.mNumMeshes; ++m) parts.push_back({scene.mMeshes[node.mMeshes[m]], transform});
  for (unsigned c = 0; c < node.mNumChildren; ++c) collect_parts(scene, *node.mChildren[c], transform, parts);
}

/// Collects triangles: corners at one point become one vertex, triangles without an area are left out.
class Collector {
 public:
  explicit Collector(std::uint64_t vertices) : join_(mesh_.vertices, vertices) {}

  /// `number`: of the vertex in its part, for the message.
  std::uint32_t add_vertex(const Vec3& at, std::size_t number) {
    if (!at.allFinite())
      throw InputError("mesh_not_finite",
                       "vertex " + std::to_string(number) +
                           " of the mesh has a coordinate that is not a finite number: repair the mesh "
                           "(for example \"remove non-finite vertices\" of a mesh editor)");
    return join_.add(at);
  }

  void add_triangle(const std::array<std::uint32_t, 3>& t) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return;
    const Vec3 a = mesh_.vertices[t[1]] - mesh_.vertices[t[0]], b = mesh_.vertices[t[2]] - mesh_.vertices[t[0]];
    if (!a.cross(b).isZero(0)) mesh_.triangles.push_back(t);
  }

  Mesh finish() {
    if (mesh_.triangles.empty())
      throw InputError("mesh_empty", "the mesh has no triangle with an area: export the surface of a solid");
    return std::move(mesh_);
  }

 private:
  Mesh mesh_;
  VertexJoin join_;
};

void add_part(const Part& part, Collector& collector, std::vector<std::uint32_t>& ids) {
  ids.resize(part.mesh->mNumVertices);
  for (unsigned v = 0; v < part.mesh->mNumVertices; ++v) {
    const aiVector3D& p = part.mesh->mVertices[v];
    ids[v] = collector.add_vertex((part.transform * Eigen::Vector4d(p.x, p.y, p.z, 1)).head<3>(), v);
  }
  for (unsigned f = 0; f < part.mesh->mNumFaces; ++f) {
    const aiFace& face = part.mesh->mFaces[f];
    if (face.mNumIndices == 3)  // else points and lines
      collector.add_triangle({ids[face.mIndices[0]], ids[face.mIndices[1]], ids[face.mIndices[2]]});
  }
}

void check_counts(std::uint64_t vertices, std::uint64_t faces, std::uint64_t memory_cap_bytes) {
  check_memory(vertices * VertexJoin::bytes_a_vertex + faces * sizeof(Mesh::triangles[0]), memory_cap_bytes,
               "its " + std::to_string(faces) + " triangles");
}

/// A mesh as its own reader gives it.
Mesh collect(const Mesh& file, std::uint64_t memory_cap_bytes) {
  check_counts(file.vertices.size(), file.triangles.size(), memory_cap_bytes);
  Collector collector(file.vertices.size());
  std::vector<std::uint32_t> ids;
  ids.reserve(file.vertices.size());
  for (const Vec3& vertex : file.vertices) ids.push_back(collector.add_vertex(vertex, ids.size()));
  for (const auto& [a, b, c] : file.triangles) collector.add_triangle({ids[a], ids[b], ids[c]});
  return collector.finish();
}

Mesh load_by_assimp(std::string_view bytes, const std::string& extension, std::uint64_t memory_cap_bytes,
                    const Watch& watch) {
  Assimp::Importer importer;
  const aiScene& scene = import_scene(importer, bytes, extension);
  std::vector<Part> parts;
  collect_parts(scene, *scene.mRootNode, Eigen::Matrix4d::Identity(), parts);
  std::uint64_t vertices = 0, faces = 0;
  for (const Part& part : parts) {
    vertices += part.mesh->mNumVertices;
    faces += part.mesh->mNumFaces;
  }
  check_counts(vertices, faces, memory_cap_bytes);  // a small glTF file may show one sub-mesh many times
  Collector collector(vertices);
  std::vector<std::uint32_t> ids;
  for (const Part& part : parts) {
    watch.step(Stage::load, bytes.size() / 2, bytes.size());
    add_part(part, collector, ids);
  }
  return collector.finish();
}

}  // namespace

std::uint64_t predict_mesh_memory(std::uint64_t file_bytes, const std::string& extension) {
  constexpr std::uint64_t importer_bytes = 4 << 20;
  return importer_bytes +
         static_cast<std::uint64_t>(static_cast<double>(file_bytes) * find_kind(extension).memory_per_byte);
}

Mesh load_mesh(std::string_view bytes, const std::string& extension, std::uint64_t memory_cap_bytes,
               const Watch& watch) {
  watch.step(Stage::load, 0, bytes.size());
  check_memory(predict_mesh_memory(bytes.size(), extension), memory_cap_bytes,
               "a ." + extension + " file of " + std::to_string(bytes.size()) + " bytes");
  check_gltf(bytes, extension);
  Mesh mesh = extension == "ply"   ? collect(read_ply(bytes, memory_cap_bytes), memory_cap_bytes)
              : extension == "off" ? collect(read_off(bytes), memory_cap_bytes)
              : extension == "dae" ? collect(read_collada(bytes, memory_cap_bytes), memory_cap_bytes)
                                   : load_by_assimp(bytes, extension, memory_cap_bytes, watch);
  watch.step(Stage::load, bytes.size(), bytes.size());
  return mesh;
}

}  // namespace sculpt
